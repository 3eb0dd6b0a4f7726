// Loading, replacing and keeping the window's model.
#include "app/view/loaded_model.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include "app/base/error.h"
#include "tests/support/scenes.h"

namespace trisect::view {
namespace {

using namespace std::chrono_literals;
using Change = LoadedModel::Change;

class LoadedModelTest : public ::testing::Test {
 protected:
  LoadedModelTest() { render_.model = test::asset_path("cube"); }

  // Small models are loaded long before the last of these waits.
  std::optional<Change> wait_for_change() {
    for (int i = 0; i < 6000; ++i) {
      if (const auto change = model_.poll(render_, message_)) return change;
      std::this_thread::sleep_for(10ms);
    }
    return std::nullopt;
  }

  void open_cube() {
    model_.open(render_);
    ASSERT_EQ(wait_for_change(), Change::opened);
  }

  RenderOptions render_;
  std::string message_;
  LoadedModel model_{std::nullopt};
};

TEST_F(LoadedModelTest, OpensAModel) {
  EXPECT_FALSE(model_.is_loaded());
  open_cube();
  EXPECT_TRUE(model_.is_loaded());
  EXPECT_FALSE(model_.is_loading());
  EXPECT_EQ(model_.shown().model, render_.model);
  EXPECT_EQ(model_.number(), 1U);
  EXPECT_GT(model_.scene().triangles.size(), 0U);
  ASSERT_EQ(model_.recent().size(), 1U);
  EXPECT_EQ(std::filesystem::path(model_.recent()[0]).filename(), "cube.obj");
}

TEST_F(LoadedModelTest, BakesAgainOnlyForOtherOptions) {
  open_cube();
  model_.request(render_);
  EXPECT_FALSE(model_.is_loading());
  render_.alpha = 0.25;
  model_.request(render_);
  ASSERT_EQ(wait_for_change(), Change::rebaked);
  EXPECT_EQ(model_.shown().choice.alpha, 0.25);
  EXPECT_EQ(model_.number(), 2U);
  // The camera does not matter to the scene.
  render_.eye = glm::dvec3(1.0, 2.0, 3.0);
  model_.request(render_);
  EXPECT_FALSE(model_.is_loading());
}

TEST_F(LoadedModelTest, ReadsAModelAgainThatIsOpenedAgain) {
  open_cube();
  model_.open(render_);
  EXPECT_TRUE(model_.is_loading());
  EXPECT_EQ(wait_for_change(), Change::opened);
  EXPECT_EQ(model_.number(), 2U);
}

TEST_F(LoadedModelTest, KeepsTheSceneIfTheNextOneFails) {
  open_cube();
  const std::string cube = render_.model;
  render_.model = "none.obj";
  render_.alpha = 0.25;
  model_.open(render_);
  ASSERT_EQ(wait_for_change(), Change::failed);
  EXPECT_NE(message_.find("none.obj"), std::string::npos) << message_;
  EXPECT_EQ(render_.model, cube);
  EXPECT_EQ(render_.alpha, RenderOptions{}.alpha);
  EXPECT_EQ(model_.shown().model, cube);
  EXPECT_EQ(model_.number(), 1U);
  EXPECT_EQ(model_.recent().size(), 1U);
  // What failed is not asked for again, and what comes next is not a model to frame.
  model_.request(render_);
  EXPECT_FALSE(model_.is_loading());
  render_.alpha = 0.5;
  model_.request(render_);
  EXPECT_EQ(wait_for_change(), Change::rebaked);
}

TEST_F(LoadedModelTest, NeedsAFirstModel) {
  render_.model = "none.obj";
  model_.open(render_);
  EXPECT_THROW(wait_for_change(), InputError);
}

}  // namespace
}  // namespace trisect::view
