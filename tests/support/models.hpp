#pragma once
/// Models of tests, read from text.

#include <gtest/gtest.h>

#include <source_location>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/input/read_model.hpp>
#include "support/messages.hpp"

namespace pounding::test {

inline Model model_of(const std::string& yaml) { return read_model(Input::read_text(yaml, "test.yaml")); }

/// Checks that the model is refused with a message at this location of its text that contains the facts.
inline void refused(const std::string& yaml, const std::string& place, const Facts& facts = {},
                    std::source_location line = std::source_location::current()) {
  expect_message(refusal<InputError>([&] { model_of(yaml); }), "test.yaml:" + place, facts, line);
}

/// Every law in the form after "law: ".
inline constexpr const char* every_law[] = {
    "linear_spring, stiffness: 9.35e7",
    "kelvin_voigt, stiffness: 9.35e7, restitution: 0.65",
    "kelvin_voigt_no_tension, stiffness: 9.35e7, restitution: 0.65",
    "komodromos, stiffness: 9.35e7, restitution: 0.65",
    "modified_linear_viscoelastic, stiffness: 9.35e7, restitution: 0.65",
    "modified_kelvin, stiffness: 9.35e7, restitution: 0.65",
    "hertz, stiffness: 2.75e9",
    "hertz_damped, stiffness: 2.75e9, restitution: 0.65",
    "jankowski, stiffness: 2.75e9, restitution: 0.65",
    "bilinear_hertz, stiffness: 2.75e9, restitution: 0.65",
    "viscous_hertz, stiffness: 2.75e9, restitution: 0.65",
    "kuwabara_kono, stiffness: 2.75e9, restitution: 0.65",
    "adams_impact, stiffness: 2.75e9, depth: 1 mm, restitution: 0.65",
    "limited_damper, stiffness: 2.75e9, restitution: 0.65",
    "stereomechanical, restitution: 0.65",
    "elastoplastic, stiffness: 2.75e9, restitution: 0.65",
    "backfill, stiffness: 250 MN/m, unloading: 500 MN/m, failure_ratio: 0.75, strength: 6 MN",
    "elastic_plastic_gap, stiffness: 1e9, yield_force: 2 MN, hardening: 2 %, damage: true",
    "tabulated, penetration: [1 mm, 5 mm], force: [1 MN, 8 MN]",
};

/// The name of a law in the form after "law: ".
inline std::string law_of(const std::string& text) { return text.substr(0, text.find(',')); }

/// The name of a test over every_law.
inline std::string law_name(const testing::TestParamInfo<const char*>& test) { return law_of(test.param); }

/// Two oscillators of the benchmark (m1 = 100 t, T1 = 0.8 s, m2 = 150 t, T2 = 0.4 s, 5 %, gap 20 mm,
/// ag = 3 sin(2 pi t/0.6) for 3 s) with this text after "law: ".
inline std::string two_oscillators(const std::string& law, double tolerance, double duration = 3.0) {
  return "ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n"
         "structures:\n"
         "  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
         "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n"
         "links:\n"
         "  - {between: [left, right], gap: 20 mm, law: " +
         law + "}\nanalysis: {duration: " + std::to_string(duration) +
         ", tolerance: " + std::to_string(tolerance * 1e6) + "e-6}\n";
}

}  // namespace pounding::test
