#include "app/dispatch/submit_budget.h"

#include <gtest/gtest.h>

namespace trisect {
namespace {

TEST(SubmitBudget, GrowsByDoublingUntilTheBudgetIsReached) {
  SubmitBudget budget;
  const double ms_per_group = 0.25;
  uint32_t groups = budget.groups();
  EXPECT_LE(groups, 16U);
  for (int i = 0; i < 20; ++i) {
    budget.record(groups, groups * ms_per_group);
    EXPECT_LE(budget.groups(), 2 * groups);
    groups = budget.groups();
  }
  EXPECT_EQ(groups, static_cast<uint32_t>(SubmitBudget::kSubmitMs / ms_per_group));
}

TEST(SubmitBudget, IsSizedByTheDearestPartOfTheImage) {
  // A few cheap submits of sky follow the expensive model. The next rows may be the model again: a
  // submit of them then takes at most about twice the budget.
  SubmitBudget budget;
  budget.record(100, 200.0);
  for (int i = 0; i < 2; ++i) budget.record(1000, 1.0);
  EXPECT_GE(budget.groups(), 50U);
  EXPECT_LE(budget.groups(), 100U);
}

TEST(SubmitBudget, ForgetsWhatHeldOneSubmitUp) {
  const double ms_per_group = 0.05;
  SubmitBudget budget;
  budget.record(1500, 1500 * ms_per_group);
  const uint32_t before = budget.groups();
  budget.record(16, 500.0);
  EXPECT_LT(budget.groups(), 10U);
  // 800 x 600 pixels: it recovers within one frame.
  uint32_t spent = 0;
  while (budget.groups() < before) {
    const uint32_t groups = budget.groups();
    budget.record(groups, groups * ms_per_group);
    spent += groups;
    ASSERT_LT(spent, 7500U);
  }
}

TEST(SubmitBudget, IsNotHeldBackByASmallLastSubmit) {
  SubmitBudget budget;
  budget.record(4000, 40.0);
  const uint32_t before = budget.groups();
  budget.record(3, 0.03);
  EXPECT_EQ(budget.groups(), before);
}

TEST(SubmitBudget, IsAtLeastOneGroup) {
  SubmitBudget budget;
  budget.record(1, 5000.0);
  EXPECT_EQ(budget.groups(), 1U);
}

}  // namespace
}  // namespace trisect
