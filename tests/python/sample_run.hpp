#pragma once
/// Results that resemble those of a run, made by a few lines of explicit time stepping, for reading and drawing without
/// the solver.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/results/results.hpp>

namespace pounding::sample {

/// A shear building of equal storeys, fixed at the ground.
struct Building {
  std::string name;
  int floors;
  double mass, stiffness, damping;  ///< per floor [kg], per storey [N/m], per storey [N s/m]
  std::vector<double> u{}, v{};     ///< relative to the ground [m], [m/s]
};

/// A linear spring and dashpot without tension, between one floor of two neighbours.
struct Touch {
  std::size_t left, right, floor;  ///< floor index from 0
  double gap;                      ///< [m]
  double force = 0, work = 0, work_at_start = 0;
  bool pressed = false;
  ImpactRow impact{};
};

constexpr double stiffness = 4e9, dashpot = 3.5e6;  ///< of a touch [N/m], [N s/m]
constexpr double step = 2e-5, output_step = 0.01;   ///< [s]

inline double ground(double t) {
  if (t > 12) return 0;
  const double envelope = std::min({1.0, t / 2, (12 - t) / 5});
  const double turn = 2 * std::numbers::pi;
  return envelope *
         (2.6 * std::sin(turn * 1.35 * t) + 1.7 * std::sin(turn * 2.3 * t + 1) + 0.9 * std::sin(turn * 4.1 * t));
}

/// A small simulation and its histories.
class Run {
 public:
  Run(std::vector<Building> buildings, std::vector<Touch> touches)
      : buildings_(std::move(buildings)), touches_(std::move(touches)) {
    for (Building& building : buildings_) {
      building.u.assign(static_cast<std::size_t>(building.floors), 0);
      building.v = building.u;
      StructureHistory history;
      history.name = building.name;
      for (int i = 1; i <= building.floors; ++i) history.floors.push_back(std::to_string(i));
      StructureEnvelope& envelope = history.envelope;
      envelope.displacement = envelope.acceleration = envelope.drift = envelope.storey_shear =
          Extremes(building.u.size());
      results_.structures.push_back(history);
    }
    for (const Touch& touch : touches_) {
      const std::string floor = std::to_string(touch.floor + 1);
      LinkHistory history;
      history.left = {buildings_[touch.left].name, static_cast<int>(touch.floor) + 1};
      history.right = {buildings_[touch.right].name, static_cast<int>(touch.floor) + 1};
      history.name = history.left.structure + "." + floor + "-" + history.right.structure + "." + floor;
      history.gap = touch.gap;
      history.law = "kelvin_voigt_no_tension";
      results_.links.push_back(history);
    }
  }

  Results simulate(double duration) {
    const int per_output = static_cast<int>(std::lround(output_step / step));
    const int steps = static_cast<int>(std::lround(duration / step));
    for (int i = 0; i <= steps; ++i) {
      const double t = i * step;
      const bool output = i % per_output == 0;
      if (output) record(t);
      for (std::size_t j = 0; j < touches_.size(); ++j)
        advance_touch(j, t, output || (touches_[j].pressed && i % 10 == 0));
      advance(ground(t));
    }
    return results_;
  }

 private:
  double penetration(const Touch& touch) const {
    return buildings_[touch.left].u[touch.floor] - buildings_[touch.right].u[touch.floor] - touch.gap;
  }

  void advance_touch(std::size_t index, double t, bool keep) {
    Touch& touch = touches_[index];
    const double depth = penetration(touch);
    const double rate = buildings_[touch.left].v[touch.floor] - buildings_[touch.right].v[touch.floor];
    touch.force = depth > 0 ? std::max(0.0, stiffness * depth + dashpot * rate) : 0;
    if (depth > 0 && !touch.pressed) {
      touch.pressed = keep = true;
      touch.work_at_start = touch.work;
      touch.impact = {};
      touch.impact.link = static_cast<int>(index);
      touch.impact.t_start = t;
      touch.impact.v_approach = rate;
    }
    touch.work += touch.force * rate * step;
    ImpactRow& impact = touch.impact;
    if (touch.force > impact.peak_force) {
      impact.peak_force = touch.force;
      impact.t_peak = t;
    }
    impact.peak_penetration = std::max(impact.peak_penetration, depth);
    impact.impulse += touch.force * step;
    if (depth <= 0 && touch.pressed) {
      touch.pressed = false;
      keep = true;
      impact.t_end = impact.t_release = t;
      impact.v_separation = -rate;
      impact.restitution = impact.v_separation / impact.v_approach;
      impact.energy_lost = touch.work - touch.work_at_start;
      results_.impacts.push_back(impact);
    }
    if (!keep) return;
    LinkHistory& history = results_.links[index];
    history.time.push_back(t);
    history.penetration.push_back(depth);
    history.velocity.push_back(rate);
    history.force.push_back(touch.force);
    history.energy.push_back(touch.work);
  }

  void advance(double ground_acceleration) {
    for (std::size_t b = 0; b < buildings_.size(); ++b) {
      Building& building = buildings_[b];
      const std::size_t floors = building.u.size();
      std::vector<double> force(floors, -building.mass * ground_acceleration);
      for (std::size_t i = 0; i < floors; ++i) {
        const double rate = building.v[i] - (i > 0 ? building.v[i - 1] : 0);
        const double drift = building.u[i] - (i > 0 ? building.u[i - 1] : 0);
        const double shear = building.stiffness * drift + building.damping * rate;
        damping_ += building.damping * rate * rate * step;
        input_ -= building.mass * ground_acceleration * building.v[i] * step;
        force[i] -= shear;
        if (i > 0) force[i - 1] += shear;
      }
      for (const Touch& touch : touches_) {
        if (touch.left == b) force[touch.floor] -= touch.force;
        if (touch.right == b) force[touch.floor] += touch.force;
      }
      for (std::size_t i = 0; i < floors; ++i) {
        building.v[i] += force[i] / building.mass * step;
        building.u[i] += building.v[i] * step;
      }
    }
  }

  void record(double t) {
    results_.time.push_back(t);
    results_.ground_acceleration.push_back(ground(t));
    double kinetic = 0, strain = 0, impact = 0;
    for (std::size_t b = 0; b < buildings_.size(); ++b) {
      const Building& building = buildings_[b];
      StructureHistory& history = results_.structures[b];
      for (std::size_t i = 0; i < building.u.size(); ++i) {
        const double drift = building.u[i] - (i > 0 ? building.u[i - 1] : 0);
        history.displacement.push_back(building.u[i]);
        history.velocity.push_back(building.v[i]);
        history.acceleration.push_back(-building.stiffness * drift / building.mass);
        history.drift.push_back(drift);
        history.storey_shear.push_back(building.stiffness * drift);
        history.envelope.displacement.update(i, t, building.u[i]);
        history.envelope.acceleration.update(i, t, history.acceleration.back());
        history.envelope.drift.update(i, t, drift);
        history.envelope.storey_shear.update(i, t, building.stiffness * drift);
        kinetic += building.mass * building.v[i] * building.v[i] / 2;
        strain += building.stiffness * drift * drift / 2;
      }
    }
    for (const Touch& touch : touches_) {
      const double depth = std::max(0.0, penetration(touch));
      strain += stiffness * depth * depth / 2;
      impact += touch.work - stiffness * depth * depth / 2;
    }
    EnergyHistory& energy = results_.energy;
    energy.time.push_back(t);
    energy.input.push_back(input_);
    energy.kinetic.push_back(kinetic);
    energy.strain.push_back(strain);
    energy.damping.push_back(damping_);
    energy.hysteretic.push_back(0);
    energy.impact.push_back(impact);
    energy.error.push_back(input_ - kinetic - strain - damping_ - impact);
  }

  std::vector<Building> buildings_;
  std::vector<Touch> touches_;
  Results results_;
  double input_ = 0, damping_ = 0;  ///< [J]
};

/// An oscillator of the given period and five per cent of critical damping.
inline Building oscillator(const std::string& name, double mass, double period) {
  const double omega = 2 * std::numbers::pi / period;
  return {name, 1, mass, mass * omega * omega, 2 * 0.05 * omega * mass};
}

/// Named runs: `two` oscillators, a `row` of three, `towers` of six floors with a link on each, `alone` without a link,
/// `quiet` with a gap that never closes, `running` and `failed`.
inline Results run(std::string_view kind) {
  const Building left = oscillator("left", 100e3, 0.8), right = oscillator("right", 150e3, 0.4);
  std::vector<Building> buildings{left, right};
  std::vector<Touch> touches{{.left = 0, .right = 1, .floor = 0, .gap = 0.02}};
  std::string title = "Two oscillators, 20 mm apart", status = "done";
  double duration = 16;
  if (kind == "row") {
    buildings.push_back(oscillator("far right", 80e3, 0.6));
    touches.push_back({.left = 1, .right = 2, .floor = 0, .gap = 0.03});
    title = "Three oscillators in a row";
  } else if (kind == "towers") {
    buildings = {{"slender", 6, 150e3, 9e7, 9e5}, {"stiff", 6, 200e3, 3.2e8, 1.5e6}};
    touches.clear();
    for (std::size_t floor = 0; floor < 6; ++floor)
      touches.push_back({.left = 0, .right = 1, .floor = floor, .gap = 0.04});
    title = "Two towers of six storeys, 40 mm apart";
  } else if (kind == "alone") {
    buildings = {left};
    touches.clear();
    title = "One oscillator";
  } else if (kind == "quiet") {
    touches[0].gap = 0.5;
    title = "Two oscillators, far apart";
  } else if (kind == "running") {
    duration = 5;
    status = "running";
  } else if (kind == "failed") {
    duration = 6;
    status = "failed: the step became smaller than 1e-12 s at t = 6.0 s";
  } else if (kind != "two") {
    throw std::invalid_argument("unknown sample");
  }
  Results results = Run(std::move(buildings), std::move(touches)).simulate(duration);
  results.version = "0.1.0";
  results.created = "2026-01-02T03:04:05Z";
  results.title = title;
  results.command = "pounding run sample.yaml";
  results.status = status;
  results.model_yaml = "title: " + title + "\n";
  results.resolved_yaml = results.model_yaml;
  results.summary_json = R"({"status": ")" + status + R"("})";
  return results;
}

}  // namespace pounding::sample
