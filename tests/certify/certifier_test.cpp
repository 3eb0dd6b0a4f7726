// What is proven of rays, against the oracle and against a second opinion in fifty digits.
#include "app/certify/certifier.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "app/bake/subpatch_bounds.h"
#include "app/certify/certified_picture.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/trace_settings.h"
#include "app/oracle/oracle_tracer.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/patch_range.h"
#include "app/surface/to_double.h"
#include "tests/certify/certificate_check.h"
#include "tests/certify/pixel_proof.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;
using in_double::SubTriangle;
using test::Opinion;

constexpr std::array kChoices{SurfaceChoice{SURFACE_FLAT, 0.0, SHELL_NORMAL},
                              SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_NORMAL},
                              SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                              SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_NORMAL},
                              SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_HEIGHT}};

bool is_cubic(const SurfaceChoice& choice) {
  return choice.surface == SURFACE_FLAT ||
         (choice.surface == SURFACE_PHONG && choice.shell == SHELL_NORMAL);
}

// Some patches across each other's way.
BakedScene random_scene(const SurfaceChoice& choice, std::mt19937_64& random) {
  BakedScene scene;
  scene.choice = choice;
  for (int i = 0; i < 5; ++i) {
    const test::RandomPatch patch = test::random_patch(random, 25.0);
    scene.triangles.push_back(bake_triangle(patch.positions, patch.normals, choice));
  }
  return scene;
}

OracleRay random_ray(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const dvec3 direction = stress::any_direction(random);
  return {dvec3(unit(random), unit(random), unit(random)) - 3.0 * direction, direction};
}

// Every ray of a tube that was proven to hit or to miss does so, by the oracle, on the triangle and
// at a t that were proven; of wide tubes, too.
TEST(Certifier, ProvesWhatTheOracleFindsForEveryRayOfATube) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  for (const SurfaceChoice& choice : kChoices) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    std::array<std::size_t, kReasons.size()> counts{};
    for (int i = 0; i < 30; ++i) {
      const BakedScene scene = random_scene(choice, random);
      const Certifier certifier(scene);
      const Oracle oracle(scene);
      for (int k = 0; k < 40; ++k) {
        const OracleRay ray = random_ray(random);
        const double radius = std::array{0.0, 1e-7, 1e-4, 1e-2}.at(static_cast<std::size_t>(k) % 4);
        const CertifiedAnswer answer = certifier.first(ray, radius);
        ++counts.at(static_cast<std::size_t>(answer.reason));
        if (!is_proven(answer.reason)) continue;
        const RayTube tube = tube_around(ray, radius);
        for (int n = 0; n < 4; ++n) {
          OracleRay other = ray;
          for (const dvec3& axis : tube.across) other.origin += axis * (radius * within(random));
          const std::vector<OracleRoot> roots = oracle.roots(other);
          ASSERT_EQ(!roots.empty(), answer.reason == Reason::one_root) << i << " " << k;
          if (roots.empty()) continue;
          EXPECT_EQ(roots[0].triangle, answer.root.triangle) << i << " " << k;
          EXPECT_GE(roots[0].t, answer.t.lo) << i << " " << k;
          EXPECT_LE(roots[0].t, answer.t.hi) << i << " " << k;
        }
      }
    }
    // Of 1,200 rays, a quarter of them with a tube that is a hundredth of the patches wide.
    EXPECT_GT(counts.at(static_cast<std::size_t>(Reason::one_root)), 150U);
    EXPECT_GT(counts.at(static_cast<std::size_t>(Reason::hulls)), 150U);
  }
}

// The baked model and the parameters of a small image of it.
struct Picture {
  BakedScene scene;
  TraceParams params;

  Picture(const std::string& asset, const SurfaceChoice& choice, uint32_t size) {
    const Mesh mesh = test::load_asset(asset);
    scene = bake(mesh, choice);
    params = make_params(scene, framed_settings(mesh, scene, size, size));
  }
};

// Nearly every pixel of a model's picture is proven, and what the robust solver finds is right.
TEST(Certifier, ProvesNearlyEveryPixel) {
  for (const SurfaceChoice& choice : kChoices) {
    for (const char* asset : {"sphere-20", "torus", "capsule"}) {
      SCOPED_TRACE(testing::Message()
                   << asset << " surface " << choice.surface << " shell " << choice.shell);
      const Mesh mesh = test::load_asset(asset);
      const BakedScene scene = bake_with_subpatches(mesh, choice);
      const TraceParams params = make_params(scene, framed_settings(mesh, scene, 64, 64));
      const CertifiedFrame proofs = *certify_frame(Certifier(scene), params, {});
      Frame frame;
      ASSERT_TRUE(trace_on_cpu(scene, params, {SOLVER_ROBUST, true, false}, frame,
                               [](uint32_t) { return true; }));
      const CertifiedAnswers answers = judge_answers(frame, proofs, scene, params);
      EXPECT_EQ(answers.wrong.size(), 0U);
      EXPECT_GT(answers.right_hits, 500U);
      EXPECT_GT(answers.right_misses, 500U);
      EXPECT_LE(answers.open, 4U);
      EXPECT_EQ(answers.right_hits + answers.right_misses + answers.open, 64U * 64U);
    }
  }
}

// An answer that is not the proven one is told.
TEST(Certifier, FindsWrongAnswers) {
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake_with_subpatches(mesh, kChoices[1]);
  const TraceParams params = make_params(scene, framed_settings(mesh, scene, 32, 32));
  const CertifiedFrame proofs = *certify_frame(Certifier(scene), params, {});
  Frame frame;
  ASSERT_TRUE(trace_on_cpu(scene, params, {SOLVER_ROBUST, true, false}, frame,
                           [](uint32_t) { return true; }));
  const std::size_t middle = 16 * 32 + 16;
  ASSERT_NE(frame.aovs[middle].triangle, NO_TRIANGLE);
  ASSERT_EQ(frame.aovs[0].triangle, NO_TRIANGLE);
  frame.aovs[middle].triangle = NO_TRIANGLE;  // missed
  frame.aovs[middle + 1].normal_z.w *= 1.2F;  // the far side
  frame.aovs[0].triangle = 3;                 // invented
  frame.aovs[middle + 3].triangle = 19;       // another patch, elsewhere
  frame.aovs[middle + 3].normal_z.w *= 1.001F;
  const CertifiedAnswers answers = judge_answers(frame, proofs, scene, params);
  ASSERT_EQ(answers.wrong.size(), 4U);
  EXPECT_EQ(answers.wrong[0].verdict, RayVerdict::wrong_hit);
  EXPECT_EQ(answers.wrong[1].verdict, RayVerdict::missed);
  EXPECT_EQ(answers.wrong[2].verdict, RayVerdict::wrong_root);
  EXPECT_EQ(answers.wrong[3].verdict, RayVerdict::wrong_patch);
  EXPECT_EQ(answers.wrong[2].x, 17U);
  EXPECT_EQ(answers.wrong[2].y, 16U);
  const Frame picture = reason_picture(proofs, answers);
  EXPECT_EQ(picture.colors[middle], vec4(1.0F));
  EXPECT_NE(picture.colors[middle + 2], vec4(1.0F));
}

// What cannot be proven is open, and for the reason that it has.
TEST(Certifier, SaysWhyAnAnswerIsOpen) {
  const SurfaceChoice flat = kChoices[0];
  const std::array<dvec3, 3> positions{dvec3(0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)};
  const std::array<dvec3, 3> up{dvec3(0.0, 0.0, 1.0), dvec3(0.0, 0.0, 1.0), dvec3(0.0, 0.0, 1.0)};
  BakedScene scene;
  scene.choice = flat;
  scene.triangles.push_back(bake_triangle(positions, up, flat));
  const dvec3 down(0.0, 0.0, -1.0);
  const auto reason = [&](const dvec3& origin, const dvec3& direction, double t_min = 0.0) {
    return Certifier(scene).first({origin, direction, t_min}, 1e-6).reason;
  };
  EXPECT_EQ(reason({0.2, 0.2, 1.0}, down), Reason::one_root);
  EXPECT_EQ(reason({5.0, 5.0, 1.0}, down), Reason::nothing_near);
  EXPECT_EQ(reason({1.1, 0.5, 1.0}, down), Reason::hulls);
  EXPECT_EQ(reason({0.6, 0.6, 1.0}, down), Reason::hulls);
  EXPECT_EQ(reason({0.9, 0.11, 1.0}, down), Reason::contraction);
  EXPECT_EQ(reason({0.5, 1e-7, 1.0}, down), Reason::border);
  EXPECT_EQ(reason({0.0, 0.0, 1.0}, down), Reason::border);
  EXPECT_EQ(reason({0.2, -1.0, 0.0}, {0.0, 1.0, 0.0}), Reason::fold);
  EXPECT_EQ(reason({0.2, 0.2, 1.0}, down, 1.0), Reason::ray_start);
  EXPECT_EQ(reason({0.2, 0.2, 1.0}, down, 1.1), Reason::hulls);
  scene.triangles.push_back(scene.triangles[0]);
  EXPECT_EQ(reason({0.2, 0.2, 1.0}, down), Reason::order);
  // The rim of a curved patch.
  const SurfaceChoice sphere = kChoices[3];
  const std::array<dvec3, 3> corners{dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0),
                                     dvec3(0.0, 0.0, 1.0)};
  scene.choice = sphere;
  scene.triangles = {bake_triangle(corners, corners, sphere)};
  const dvec3 rim = glm::normalize(dvec3(1.0, 1.0, 0.7));
  const dvec3 along = glm::normalize(glm::cross(rim, dvec3(0.0, 0.0, 1.0)));
  EXPECT_EQ(reason(rim - 3.0 * along, along), Reason::fold);
  EXPECT_EQ(reason(rim * 0.99 - 3.0 * along, along), Reason::one_root);
  EXPECT_TRUE(is_proven(reason(rim * 1.01 - 3.0 * along, along)));
}

// A second opinion in fifty digits refutes none of the certificates of a picture, of which every
// other pixel's ray begins behind its first hit, and together they prove its answer.
// scripts/certify.sh has a million of each model.
TEST(Certificates, HoldInFiftyDigitsAndLeaveNoGap) {
  std::array<std::size_t, 5> kinds{};
  for (const SurfaceChoice& choice : kChoices) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    const Picture picture("torus", choice, 24);
    const Certifier certifier(picture.scene);
    std::array<std::array<std::size_t, 4>, 5> counts{};
    const double radius = kMotion * static_cast<double>(picture.params.anchor.w);
    std::size_t number = 0;
    std::size_t proven = 0;
    for (uint32_t y = 0; y < 24; ++y) {
      for (uint32_t x = 0; x < 24; ++x) {
        OracleRay ray = oracle_pixel_ray(picture.params, x, y).ray;
        const CertifiedAnswer front = certifier.first(ray, radius);
        if (x % 2 == 1 && front.reason == Reason::one_root) ray.t_min = front.t.hi + 0.01;
        std::vector<Certificate> certificates;
        const CertifiedAnswer answer = certifier.first(ray, radius, &certificates);
        const RayTube tube = tube_around(ray, radius);
        if (is_proven(answer.reason)) {
          ++proven;
          EXPECT_EQ(test::gap_in(certificates, answer, tube, picture.scene.triangles), "");
        }
        for (const Certificate& certificate : certificates) {
          if (++number % 13 != 0) continue;
          const Opinion opinion = test::opinion_on(certificate, tube, with_single_alpha(choice),
                                                   picture.scene.triangles[certificate.triangle]);
          ++kinds.at(static_cast<std::size_t>(certificate.kind));
          ++counts.at(static_cast<std::size_t>(certificate.kind))
                .at(static_cast<std::size_t>(opinion));
        }
      }
    }
    EXPECT_GT(proven, 570U);
    for (const auto& of_kind : counts) {
      EXPECT_EQ(of_kind[static_cast<std::size_t>(Opinion::refuted)], 0U);
    }
    const auto& roots = counts[static_cast<std::size_t>(CertificateKind::one_root)];
    EXPECT_GT(roots[static_cast<std::size_t>(Opinion::supported)], 5U);
    EXPECT_EQ(roots[static_cast<std::size_t>(Opinion::unknown)], 0U);
    EXPECT_GT(counts[0][static_cast<std::size_t>(is_cubic(choice) ? Opinion::proven
                                                                  : Opinion::supported)],
              50U);
  }
  for (const std::size_t count : kinds) EXPECT_GT(count, 10U);
}

// The surfaces written once more are those that the program has, also where lines miss their
// spheres, where heights are held, and beyond the patch.
TEST(Certificates, AreLookedAtWithTheProgramsSurfaces) {
  std::mt19937_64 random(44);
  const SubTriangle beyond{dvec3(-0.125), 1.375};
  double farthest = 0.0;
  for (const SurfaceChoice& choice : test::kSurfaceChoices) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    const SurfaceChoice kernels_choice = with_single_alpha(choice);
    std::size_t held = 0;
    BakedScene scene = bake(test::wild_patches(80), choice);
    for (int i = 0; i < 120; ++i) {
      const test::RandomPatch corners = test::random_patch(random, 90.0);
      Triangle tri = bake_triangle(corners.positions, corners.normals, choice);
      // Curvatures that the normals do not go with, so that heights come to be held.
      for (vec4& data : tri.VertexData) data.x = i % 2 == 0 ? -6.0F : 6.0F;
      scene.triangles.push_back(tri);
    }
    for (const Triangle& tri : scene.triangles) {
      if (!has_surface(tri)) continue;
      const Patch patch = patch_of(choice.shell, tri);
      for (const dvec3& l : test::weight_grid(8)) {
        const dvec3 w = in_double::weights_of(beyond, l);
        const dvec3 T = in_double::base_point(patch.triangle, w);
        const dvec3 D = in_double::shell_direction(choice.shell, patch.triangle, w);
        // Roundings of D count |D| times less.
        const double steep = longest_of(patch.D) / glm::length(D);
        const dvec3 S = in_double::surface_point(shape_of(kernels_choice), patch.triangle, w);
        const double off = glm::distance(S, test::point_in_fifty_digits(kernels_choice, tri, w));
        farthest = std::max(farthest, off / (steep * steep * patch.longest));
        if (choice.surface != SURFACE_SPHERE) continue;
        const dvec3 blends = in_double::curvature_blends(patch.triangle, w, T);
        for (int k = 0; k < 3; ++k) {
          const auto line = in_double::vertex_line(patch.triangle, k, T, D, blends[k]);
          if (!in_double::is_free(line)) ++held;
        }
      }
    }
    if (choice.surface == SURFACE_SPHERE) {
      EXPECT_GT(held, 50U);
    }
  }
  // A hundred roundings or so, however short D is.
  EXPECT_LT(farthest, 1e-13);
}

// Roundings do not vanish where the surface passes the scene's origin and the ray begins there.
TEST(Certificates, HoldNearTheScenesOrigin) {
  std::mt19937_64 random(43);
  std::size_t roots = 0;
  for (const SurfaceChoice& choice : kChoices) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    for (int i = 0; i < 60; ++i) {
      test::RandomPatch patch = test::random_patch(random, 10.0);
      const dvec3 w = test::random_weights(random);
      const dvec3 point =
          patch.positions[0] * w.x + patch.positions[1] * w.y + patch.positions[2] * w.z;
      for (dvec3& position : patch.positions) position -= point;
      BakedScene scene;
      scene.choice = choice;
      scene.triangles.push_back(bake_triangle(patch.positions, patch.normals, choice));
      const OracleRay ray{dvec3(0.0), stress::any_direction(random), -1.0};
      std::vector<Certificate> certificates;
      static_cast<void>(Certifier(scene).first(ray, 0.0, &certificates));
      for (const Certificate& certificate : certificates) {
        if (certificate.kind == CertificateKind::one_root) ++roots;
        EXPECT_NE(test::opinion_on(certificate, tube_around(ray, 0.0), with_single_alpha(choice),
                                   scene.triangles[0]),
                  Opinion::refuted)
            << i;
      }
    }
  }
  EXPECT_GT(roots, 150U);
}

// A proof that lacks a certificate, or rests on the wrong one, has a gap.
TEST(Certificates, LeaveAGapIfOneIsMissingOrBelongsElsewhere) {
  const Picture picture("sphere-20", kChoices[1], 24);
  const Certifier certifier(picture.scene);
  const double radius = kMotion * static_cast<double>(picture.params.anchor.w);
  const OracleRay ray = oracle_pixel_ray(picture.params, 11, 12).ray;
  const RayTube tube = tube_around(ray, radius);
  std::vector<Certificate> certificates;
  const CertifiedAnswer answer = certifier.first(ray, radius, &certificates);
  ASSERT_EQ(answer.reason, Reason::one_root);
  const auto gap = [&](const std::vector<Certificate>& some, const CertifiedAnswer& claim) {
    return test::gap_in(some, claim, tube, picture.scene.triangles);
  };
  ASSERT_EQ(gap(certificates, answer), "");
  std::size_t behind = 0;
  std::size_t needed = 0;
  for (std::size_t i = 0; i < certificates.size(); ++i) {
    std::vector<Certificate> fewer = certificates;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (gap(fewer, answer).empty()) {
      // Of a triangle whose box alone is met, which none of its certificates is needed for.
      std::erase_if(fewer, [&](const Certificate& other) {
        return other.triangle == certificates[i].triangle;
      });
      EXPECT_EQ(gap(fewer, answer), "") << i;
    } else {
      ++needed;
    }
    if (certificates[i].kind != CertificateKind::behind) continue;
    ++behind;
    std::vector<Certificate> nearer = certificates;
    nearer[i].t.lo -= 0.1;
    EXPECT_EQ(gap(nearer, answer), "what is left out may be nearer");
  }
  EXPECT_GT(behind, 0U);
  EXPECT_GT(needed, 10U);
  CertifiedAnswer other = answer;
  other.reason = Reason::hulls;
  EXPECT_EQ(gap(certificates, other), "there is a root");
  other = answer;
  other.root.triangle += 1;
  EXPECT_EQ(gap(certificates, other), "the answer's root is none");
}

// Certificates with a mistake in them are refuted: a piece that reaches into the tube, the other
// side, a root that is elsewhere or farther, or where none is.
TEST(Certificates, AreRefutedIfTheyAreWrong) {
  for (const SurfaceChoice& choice : kChoices) {
    SCOPED_TRACE(testing::Message() << "surface " << choice.surface << " shell " << choice.shell);
    const Picture picture("sphere-20", choice, 24);
    const Certifier certifier(picture.scene);
    const double radius = kMotion * static_cast<double>(picture.params.anchor.w);
    const OracleRay ray = oracle_pixel_ray(picture.params, 11, 12).ray;
    const RayTube tube = tube_around(ray, radius);
    std::vector<Certificate> certificates;
    ASSERT_EQ(certifier.first(ray, radius, &certificates).reason, Reason::one_root);
    std::array<std::size_t, 5> seen{};
    for (const Certificate& right : certificates) {
      ++seen.at(static_cast<std::size_t>(right.kind));
      const auto opinion = [&](const Certificate& certificate) {
        return test::opinion_on(certificate, tube, with_single_alpha(choice),
                                picture.scene.triangles[certificate.triangle]);
      };
      ASSERT_NE(opinion(right), Opinion::refuted);
      Certificate wrong = right;
      if (right.kind == CertificateKind::hull) {
        wrong.axis = -right.axis;
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
        wrong = right;
        wrong.kind = CertificateKind::before;
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
      }
      if (right.kind == CertificateKind::one_root) {
        wrong.weights.y += 1.1 * wrong.weight_radius;
        wrong.weights.x -= 1.1 * wrong.weight_radius;
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
        wrong = right;
        wrong.t.hi = 0.5 * right.t.lo + 0.5 * right.t.hi;
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
        wrong = right;
        wrong.kind = CertificateKind::no_root;
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
        wrong.kind = CertificateKind::hull;
        wrong.axis = {1.0, 0.0};
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
        wrong.kind = CertificateKind::behind;
        EXPECT_EQ(opinion(wrong), Opinion::refuted);
      }
    }
    EXPECT_GT(seen.at(static_cast<std::size_t>(CertificateKind::hull)), 0U);
    EXPECT_GT(seen.at(static_cast<std::size_t>(CertificateKind::one_root)), 0U);
  }
}

}  // namespace
}  // namespace trisect
