#pragma once
/// Short ways to run a model in a test.

#include <string>

#include <pounding/analysis.hpp>
#include <pounding/input.hpp>
#include <pounding/structures.hpp>

namespace pounding::test {

inline Model model_of(const std::string& yaml) { return read_model(Input::read_text(yaml, "test.yaml"), kinds()); }

inline Outcome run_text(const std::string& yaml) {
  const Model model = model_of(yaml);
  return run(model);
}

/// Two oscillators of LAWS T11 (m1 = 100 t, T1 = 0.8 s, m2 = 150 t, T2 = 0.4 s, 5 %, gap 20 mm,
/// ag = 3 sin(2 pi t/0.6) for 3 s) with this text after "law: ".
inline std::string two_oscillators(const std::string& law, double tolerance, double duration = 3.0) {
  return "ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\n"
         "structures:\n"
         "  left:  {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
         "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n"
         "links:\n"
         "  - {between: [left, right], gap: 20 mm, law: " +
         law + "}\nanalysis: {duration: " + std::to_string(duration) + ", tolerance: " + std::to_string(tolerance * 1e6) +
         "e-6}\n";
}

}  // namespace pounding::test
