// What a ray is taken to miss, in single precision.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/base/rounding.h"
#include "app/dispatch/kernel_float.h"
#include "app/dispatch/trace_settings.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// A ray with no beginning, and a ball that it touches: the ball's centre is up to 1000 away from
// its anchor, and its radius is the exact distance of the centre from the ray, rounded up.
struct TouchedBall {
  CastRay ray;
  vec4 ball;
  double along;  // of the centre, from the anchor

  explicit TouchedBall(std::mt19937_64& random) {
    const auto power = [&](int least) {
      return std::ldexp(1.0, least + static_cast<int>(random() % 20));
    };
    ray.anchor = vec4(glm::vec3(power(-10) * stress::any_direction(random)), -1e30F);
    ray.direction = vec4(glm::vec3(stress::any_direction(random)), 0.0F);
    const dvec3 anchor(ray.anchor);
    const dvec3 view = glm::normalize(dvec3(ray.direction));
    ball = vec4(glm::vec3(anchor + power(-10) * view + power(-16) * stress::any_direction(random)),
                0.0F);
    const dvec3 center = dvec3(ball) - anchor;
    along = glm::dot(center, view);
    ball.w = rounded_up(glm::length(glm::cross(center, view)));
  }
};

class Balls : public testing::Test {
 protected:
  // Whether the ray is taken to miss the ball before its hit at z.
  bool is_missed(const CastRay& ray, const vec4& ball, float z) {
    return kernel_.misses_ball(kernel_.ray_of_cast(ray), ball, z);
  }

 private:
  BakedScene scene_ = bake(test::load_asset("sphere-20"), {});
  TraceParams params_ = make_params(scene_, TraceSettings{});
  in_float::Kernel kernel_ = in_float::kernel_of(scene_, params_, {});
};

TEST_F(Balls, AreMetByRaysThatTouchThem) {
  std::mt19937_64 random(1);
  std::size_t missed = 0;
  for (int i = 0; i < 200000; ++i) {
    TouchedBall touched(random);
    ASSERT_FALSE(is_missed(touched.ray, touched.ball, 1e30F)) << i;
    // A ball that is smaller by more than roundings is missed.
    const double size = std::hypot(touched.along, touched.ball.w);
    touched.ball.w *= 0.9F;
    if (touched.ball.w < 1e-2 * size) continue;
    ++missed;
    EXPECT_TRUE(is_missed(touched.ray, touched.ball, 1e30F)) << i;
  }
  EXPECT_GT(missed, 10000U);
}

// Nothing that a ball contains is nearer than its nearest point, but that near it may be.
TEST_F(Balls, AreMetByRaysWithAHitWhereTheyBegin) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200000; ++i) {
    TouchedBall touched(random);
    const double radius = touched.ball.w + unit(random) * std::abs(touched.along);
    touched.ball.w = rounded_up(radius);
    const double begins = touched.along - touched.ball.w;
    ASSERT_FALSE(is_missed(touched.ray, touched.ball, rounded_up(begins))) << i;
    // One well before it is nearer than all of that.
    EXPECT_TRUE(is_missed(touched.ray, touched.ball,
                          static_cast<float>(begins - 1e-4 * (radius + std::abs(touched.along)))))
        << i;
  }
}

}  // namespace
}  // namespace trisect
