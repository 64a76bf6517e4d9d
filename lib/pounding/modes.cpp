#include <pounding/modes.hpp>

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pounding/damping.hpp>

namespace pounding {

std::vector<Mode> modes(const Structure& s) {
  std::vector<Mode> found;
  if (s.is_rigid()) return found;
  const Eigenmodes solved = eigenmodes(s.mass, s.stiffness);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(s.size());
  for (int i = 0; i < s.size(); ++i) {
    const double w = solved.frequencies[i];
    const Eigen::VectorXd unit = solved.shapes.col(i);  // phi^T M phi = 1
    const double load = unit.dot(s.mass * ones);
    const double top = unit[s.size() - 1];
    Mode mode;
    mode.period = w > 0 ? 2 * M_PI / w : std::numeric_limits<double>::infinity();
    mode.damping_ratio = w > 0 ? unit.dot(s.damping * unit) / (2 * w) : 0;
    mode.effective_mass = load * load;
    mode.participation = load * top;
    mode.shape = unit / top;
    found.push_back(std::move(mode));
  }
  return found;
}

std::string modes_table(const Model& model) {
  std::string text;
  for (const Structure& s : model.structures) {
    if (s.is_rigid()) continue;
    const double total = s.mass.diagonal().sum();
    text += fmt::format("{} ({}, {} floor{}, {:.6g} t, damping: {})\n", s.name, s.kind, s.size(), s.size() == 1 ? "" : "s",
                        total / 1e3, s.damping_note);
    text += "mode   period (s)  frequency (Hz)  damping (%)  participation  effective mass (%)  shape from the ground up\n";
    int number = 0;
    double sum = 0;
    for (const Mode& mode : modes(s)) {
      sum += mode.effective_mass;
      text += fmt::format("{:>4}  {:>11.6f}  {:>14.6f}  {:>11.4f}  {:>13.5f}  {:>18.3f} ", ++number, mode.period,
                          1 / mode.period, 100 * mode.damping_ratio, mode.participation, 100 * mode.effective_mass / total);
      for (const double amplitude : mode.shape) text += fmt::format(" {:.4f}", amplitude);
      text += '\n';
    }
    text += fmt::format("effective masses add up to {:.3f} % of {:.6g} t\n\n", 100 * sum / total, total / 1e3);
  }
  return text;
}

std::string modes_json(const Model& model) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Structure& s : model.structures) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Mode& mode : modes(s)) {
      nlohmann::ordered_json one;
      if (std::isfinite(mode.period))
        one["period"] = mode.period;
      else
        one["period"] = nullptr;
      one["damping_ratio"] = mode.damping_ratio;
      one["participation"] = mode.participation;
      one["effective_mass"] = mode.effective_mass;
      one["shape"] = std::vector<double>(mode.shape.begin(), mode.shape.end());
      list.push_back(std::move(one));
    }
    all[s.name] = std::move(list);
  }
  return all.dump();
}

}  // namespace pounding
