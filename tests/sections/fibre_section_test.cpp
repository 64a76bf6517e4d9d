/// Response, states and energies of fibre sections.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/sections/builders.hpp>
#include <pounding/sections/fibre_section.hpp>
#include "sections/reinforced_column.hpp"
#include "support/messages.hpp"

namespace pounding::sections {
namespace fibre_section_test {

/// Every material of the catalogue, in groups whose sizes are not multiples of the vector width.
FibreSection section_of_all_materials() {
  std::vector<materials::AnyMaterial> all;
  Fibres fibres;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(-0.2, 0.2);
  for (const materials::Entry& entry : materials::catalogue()) {
    for (std::size_t i = 0; i < 5 + 13 * all.size(); ++i) fibres.push_back({at(random), at(random), 1e-4, all.size()});
    all.push_back(materials::make_material(hysteresis::typical_settings(entry)));
  }
  return {all, fibres};
}

Deformation random_deformation(std::mt19937& random) {
  std::uniform_real_distribution<double> strain(-0.004, 0.003), curvature(-0.03, 0.03);
  return {strain(random), curvature(random), curvature(random)};
}

double strain_at(const Deformation& d, const Fibre& f) { return d[0] + f.z * d[1] - f.y * d[2]; }

TEST(FibreSection, TheVectorLoopEqualsTheScalarLaws) {
  const FibreSection section = section_of_all_materials();
  std::mt19937 random(2);
  FibreStates states = section.states();
  for (int step = 0; step < 50; ++step) {
    const Deformation d = random_deformation(random);
    const SectionResponse response = section.evaluate(states, d);
    SectionResponse expected;
    double forces = 0, stiffnesses = 0;
    std::size_t fibre = 0;
    for (auto& group : states)
      std::visit(
          [&]<class M>(materials::Lanes<M>& lanes) {
            for (const typename M::State& state : lanes.states()) {
              const Fibre& f = section.fibres()[fibre++];
              const auto answer = std::get<M>(section.materials()[f.material]).respond(state, strain_at(d, f));
              const std::array<double, 3> b{1, f.z, -f.y};
              for (std::size_t i = 0, n = 0; i < 3; ++i) {
                expected.force[i] += b[i] * f.area * answer.force;
                for (std::size_t j = i; j < 3; ++j) expected.stiffness[n++] += b[i] * b[j] * f.area * answer.slope;
              }
              forces += f.area * std::abs(answer.force), stiffnesses += f.area * std::abs(answer.slope);
            }
          },
          group);
    ASSERT_EQ(fibre, section.fibres().size());
    for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(response.force[i], expected.force[i], 1e-14 * forces) << step;
    for (std::size_t i = 0; i < 6; ++i)
      ASSERT_NEAR(response.stiffness[i], expected.stiffness[i], 1e-14 * stiffnesses) << step;
    section.accept(states, d);
  }
}

TEST(FibreSection, ThePlaneSectionEqualsTheSpaceSection) {
  Fibres fibres = rc_rectangle(test::column_dimensions());
  const FibreSection plane{test::column_materials("menegotto_pinto"), fibres};
  for (Fibre& fibre : fibres) fibre.y = 0.1;
  const FibreSection space{test::column_materials("menegotto_pinto"), fibres};
  FibreStates in_plane = plane.states(), in_space = space.states();
  for (const double curvature : {0.01, -0.01, 0.03, 0.0}) {
    const Deformation d{-0.0005, curvature, 0};
    const SectionResponse p = plane.evaluate(in_plane, d), s = space.evaluate(in_space, d);
    EXPECT_EQ(p.force[0], s.force[0]);
    EXPECT_EQ(p.force[1], s.force[1]);
    EXPECT_EQ(p.force[2], 0);
    EXPECT_NEAR(s.force[2], -0.1 * s.force[0], 1e-12 * std::abs(s.force[0]));
    EXPECT_NEAR(s.stiffness[4], -0.1 * s.stiffness[1], 1e-12 * std::abs(s.stiffness[3]));
    plane.accept(in_plane, d), space.accept(in_space, d);
  }
}

TEST(FibreSection, TheStiffnessIsTheDerivative) {
  RcRectangle dimensions = test::column_dimensions();
  dimensions.across = 5;
  const FibreSection section{test::column_materials("menegotto_pinto"), rc_rectangle(dimensions)};
  std::mt19937 random(3);
  FibreStates states = section.states();
  for (int step = 0; step < 20; ++step) {
    const Deformation d = random_deformation(random);
    const auto k = section.evaluate(states, d).stiffness;
    const std::array<std::array<double, 3>, 3> full{{{k[0], k[1], k[2]}, {k[1], k[3], k[4]}, {k[2], k[4], k[5]}}};
    for (std::size_t j = 0; j < 3; ++j) {
      const double h = 1e-9 * (j == 0 ? 1 : 10);
      Deformation up = d, down = d;
      up[j] += h, down[j] -= h;
      const auto f_up = section.evaluate(states, up).force, f_down = section.evaluate(states, down).force;
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(full[i][j], (f_up[i] - f_down[i]) / (2 * h), 3e-4 * 3e9) << step << ": " << i << j;
    }
    section.accept(states, d);
  }
}

// Fibres of one material in the same order, interleaved with those of others: bitwise the same result.
TEST(FibreSection, TheOrderOfFibresIsIrrelevant) {
  Fibres fibres = rc_rectangle(test::column_dimensions()), interleaved = fibres;
  std::ranges::rotate(interleaved, interleaved.begin() + 30);
  std::ranges::stable_sort(interleaved, {}, [](const Fibre& f) { return std::pair(f.material, f.z); });
  std::ranges::stable_sort(fibres, {}, [](const Fibre& f) { return std::pair(f.z, f.material); });
  const FibreSection one{test::column_materials("steel01"), fibres},
      other{test::column_materials("steel01"), interleaved};
  const Deformation d{-0.001, 0.02, 0};
  EXPECT_EQ(one.evaluate(one.states(), d).force, other.evaluate(other.states(), d).force);
  std::ranges::reverse(fibres);
  const FibreSection reversed{test::column_materials("steel01"), fibres};
  EXPECT_NEAR(reversed.evaluate(reversed.states(), d).force[1], one.evaluate(one.states(), d).force[1], 1e-9);
}

TEST(FibreSection, TheMirroredCurvatureHasTheMirroredMoment) {
  const FibreSection section = test::reinforced_column("steel01");
  FibreStates up = section.states(), down = section.states();
  for (const double curvature : {0.01, -0.02, 0.005}) {
    const auto a = section.evaluate(up, {-0.001, curvature, 0}), b = section.evaluate(down, {-0.001, -curvature, 0});
    EXPECT_NEAR(a.force[0], b.force[0], 1e-9 * std::abs(a.force[0]));
    EXPECT_NEAR(a.force[1], -b.force[1], 1e-9 * std::abs(a.force[1]));
    section.accept(up, {-0.001, curvature, 0}), section.accept(down, {-0.001, -curvature, 0});
  }
}

TEST(FibreSection, ElasticFibresHaveTheElasticStiffness) {
  const FibreSection section{{materials::make_material({.law = "elastic", .values = {{"E", 200e9}}})},
                             rectangle(0.2, 0.4, 0, 200, 100)};
  const auto k = section.evaluate(section.states(), {0.3, 0.1, -0.2}).stiffness;
  EXPECT_NEAR(k[0], 200e9 * 0.08, 1);
  EXPECT_NEAR(k[3], 200e9 * 0.2 * 0.064 / 12, 1e-4 * k[3]);
  EXPECT_NEAR(k[5], 200e9 * 0.4 * 0.008 / 12, 2e-4 * k[5]);
  for (const std::size_t i : {1u, 2u, 4u}) EXPECT_NEAR(k[i], 0, 1e-3);
}

TEST(FibreSection, StatesAreRestoredBitwise) {
  const FibreSection section = section_of_all_materials();
  std::mt19937 random(4);
  FibreStates states = section.states();
  for (int i = 0; i < 10; ++i) section.accept(states, random_deformation(random));
  FibreStates copy = section.states();
  for (std::size_t g = 0; g < states.size(); ++g)
    std::visit(
        [&]<class M>(materials::Lanes<M>& lanes) {
          const auto kept = std::get<materials::Lanes<M>>(states[g]).states();
          std::vector<typename M::State> bytes(kept.size());
          std::memcpy(static_cast<void*>(bytes.data()), kept.data(), kept.size_bytes());
          lanes.restore(std::get<M>(section.materials()[g]), bytes);
        },
        copy[g]);
  for (int i = 0; i < 10; ++i) {
    const Deformation d = random_deformation(random);
    EXPECT_EQ(section.evaluate(states, d).force, section.evaluate(copy, d).force);
    section.accept(states, d), section.accept(copy, d);
  }
}

// Curvature sampled from a parabola in time with its extremum at t = 0.55: fibres reverse there.
// The lower fibre ruptures in tension; two fibres at one point are parallel, and the elastic one carries on.
TEST(FibreSection, AModifiedMaterialRupturesNextToOthers) {
  const auto elastic = materials::make_material({.law = "elastic", .values = {{"E", 1e9}}});
  materials::Modified<materials::NamedMaterial> steel;
  steel.base = materials::Materials::make({.law = "steel01", .values = {{"Fy", 250e6}, {"E0", 200e9}, {"b", 0}}});
  steel.max = 0.005;
  const FibreSection section({steel, elastic}, {{0, 0.1, 1e-3, 0}, {0, -0.1, 1e-3, 0}, {0, -0.1, 1e-3, 1}});
  EXPECT_TRUE(section.forgets_small_reversals());
  FibreStates states = section.states();
  section.accept(states, {0, -0.04, 0});
  const double elastic_force = 1e9 * 0.004 * 1e-3;
  EXPECT_NEAR(section.evaluate(states, {0, -0.04, 0}).force[0], elastic_force, 1e-6);
  section.accept(states, {0, -0.06, 0});
  for (const double ratio : {1.0, 0.9}) {
    const SectionResponse end = section.evaluate(states, {0, -0.06 * ratio, 0});
    const double upper = -(250e6 - 200e9 * 0.006 * (1 - ratio)) * 1e-3, lower = 1e9 * 0.006 * ratio * 1e-3;
    EXPECT_NEAR(end.force[0], upper + lower, 1e-6);
    EXPECT_NEAR(end.force[1], 0.1 * (upper - lower), 1e-6);
  }
}

TEST(Reversals, FibresFollowTheExtremumInsideAStep) {
  const FibreSection section = test::reinforced_column("steel01");
  const std::vector<double> times{0, 83.0 / 250, 0.5, 31.0 / 50, 17.0 / 20, 1};
  const auto at = [](double t) { return Deformation{-2e-4, 0.02 - 0.05 * (t - 0.55) * (t - 0.55), 0}; };
  std::vector<Deformation> samples;
  for (const double t : times) samples.push_back(at(t));
  FibreStates begin = section.states();
  section.accept(begin, at(0));
  FibreStates followed = begin, expected = begin, straight = begin;
  EXPECT_TRUE(section.may_reverse({times, samples}));
  EXPECT_TRUE(section.accept(followed, {times, samples}, 1e-6).reversed);
  section.accept(expected, at(0.55)), section.accept(expected, at(1));
  section.accept(straight, at(1));
  const Deformation probe{-3e-4, 0.012, 0};
  const double moment = section.evaluate(expected, probe).force[1];
  EXPECT_NEAR(section.evaluate(followed, probe).force[1], moment, 1e-9 * std::abs(moment));
  EXPECT_GT(std::abs(section.evaluate(straight, probe).force[1] - moment), 1e-3 * std::abs(moment));
  // Below the threshold, the path is straight.
  EXPECT_FALSE(section.accept(begin, {times, samples}, 1).reversed);
  EXPECT_EQ(section.evaluate(begin, probe).force, section.evaluate(straight, probe).force);
}

TEST(Reversals, AMonotonicStepHasNone) {
  const FibreSection section = test::reinforced_column("steel01");
  const std::vector<double> times{0, 0.3, 0.6, 1};
  std::vector<Deformation> samples;
  for (const double t : times) samples.push_back({1e-3 * t, 1e-3 * t * t, 0});
  EXPECT_FALSE(section.may_reverse({times, samples}));
  samples[2][1] = 0.02;
  EXPECT_TRUE(section.may_reverse({times, samples}));
}

TEST(Reversals, TheExtremumOfAParabolaIsExact) {
  const std::vector<double> times{0, 0.3, 0.6, 1};
  const auto sampled = [&](double top, double value, double bend) {
    std::vector<double> strains;
    for (const double t : times) strains.push_back(value + bend * (t - top) * (t - top));
    return find_reversal(times, strains);
  };
  for (const double top : {0.02, 0.1, 0.35, 0.5, 0.8, 0.99})
    for (const double bend : {-2.0, 3.0}) {
      ASSERT_TRUE(sampled(top, 0.7, bend)) << top;
      EXPECT_NEAR(*sampled(top, 0.7, bend), 0.7, 1e-14) << top;
    }
  for (const double top : {-0.3, 1.2}) EXPECT_FALSE(sampled(top, 0.7, -2)) << top;
}

// Work by the trapezoidal rule along a cycle.
TEST(Energy, LostAndStoredEnergyAreTheWorkOfTheForces) {
  const FibreSection section = test::reinforced_column("menegotto_pinto");
  FibreStates states = section.states();
  Deformation last{};
  double lost = 0, work = 0, largest = 0;
  for (const double target : {0.02, -0.03, 0.04, 0.0}) {
    const double begin = last[1];
    for (int i = 1; i <= 2000; ++i) {
      const double curvature = begin + (target - begin) * i / 2000;
      const Deformation next{0.01 * std::abs(curvature), curvature, 0};
      const auto before = section.evaluate(states, last).force, after = section.evaluate(states, next).force;
      for (std::size_t j = 0; j < 3; ++j) work += 0.5 * (before[j] + after[j]) * (next[j] - last[j]);
      lost += section.lost(states, next);
      section.accept(states, next);
      last = next;
    }
    largest = std::max(largest, std::abs(work));
    EXPECT_GT(section.stored(states), 0);
    EXPECT_NEAR(lost + section.stored(states), work, 1e-5 * largest) << target;
  }
  EXPECT_GT(lost, 1e4);
}

TEST(FibreSection, InvalidFibresAreRejected) {
  const auto all = test::column_materials("steel01");
  const auto refusal = [&](const Fibres& fibres) { return test::refusal([&] { FibreSection(all, fibres); }); };
  EXPECT_TRUE(test::mentions(refusal({}), {"fibre"}));
  EXPECT_TRUE(test::mentions(refusal({{0, 0, -1, 0}}), {"area", "-1"}));
  EXPECT_TRUE(test::mentions(refusal({{0, 0, 1, 3}}), {"material", "3"}));
  EXPECT_TRUE(test::mentions(refusal({{std::nan(""), 0, 1, 0}}), {"point"}));
}

}  // namespace fibre_section_test
}  // namespace pounding::sections
