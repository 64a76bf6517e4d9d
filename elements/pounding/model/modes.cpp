#include <pounding/model/modes.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pounding {
namespace {

using Json = nlohmann::ordered_json;

// Structures with more unknowns are not solved for the ratios alone.
constexpr int max_for_ratios = 200;

constexpr std::string_view axes[] = {"x", "y", "z"};

bool along_x_only(const Structure& s) { return s.dimension == 1; }

// Scale factor from a shape with phi^T M phi = 1 to the reported one.
double scale(const Structure& s, const Eigen::MatrixXd& floors, const Eigen::VectorXd& unit) {
  if (along_x_only(s)) return 1 / floors(floors.rows() - 1, 0);
  double largest = 0;
  for (int j = 0; j < std::min<int>(2, static_cast<int>(floors.cols())); ++j)
    for (int i = 0; i < floors.rows(); ++i)
      if (std::abs(floors(i, j)) > (1 + 1e-9) * std::abs(largest)) largest = floors(i, j);
  // A mode without horizontal floor motion is scaled to a maximum unknown of 1.
  if (std::abs(largest) < 1e-6 * unit.cwiseAbs().maxCoeff()) largest = unit.cwiseAbs().maxCoeff();
  return 1 / largest;
}

Eigen::MatrixXd floor_motion(const Structure& s, const Eigen::VectorXd& q) {
  const int floors = static_cast<int>(s.floors.size());
  const int directions = floors == 0 ? 0 : static_cast<int>(s.floors.front().motion.size());
  Eigen::MatrixXd motion(floors, directions);
  for (int i = 0; i < floors; ++i)
    for (int j = 0; j < directions; ++j) motion(i, j) = s.floors[i].motion[j].dot(q);
  return motion;
}

int count_of(const Structure& s, int max_count) { return along_x_only(s) ? s.size() : std::min(max_count, s.size()); }

Eigen::MatrixX3d whole_load(const Structure& s) {
  Eigen::MatrixX3d load = Eigen::MatrixX3d::Zero(s.size(), 3);
  for (const Support& support : s.supports) load += support.load;
  return load;
}

}  // namespace

std::vector<Mode> modes(const Structure& s, int count, const ModeSolver& solver) {
  std::vector<Mode> found;
  if (s.is_rigid()) return found;
  const int available = static_cast<int>(split_by_mass(s.mass).dynamic.size());
  const Eigenmodes solved = solver(s.mass, s.stiffness, std::min(count, available));
  const Eigen::MatrixX3d load = whole_load(s);
  const SparseMatrix damping = s.formed_damping();
  const double unformed = s.modal_damping.size() > 0 ? 0 : s.modal_ratio;
  for (int i = 0; i < solved.frequencies.size(); ++i) {
    const double w = solved.frequencies[i];
    const Eigen::VectorXd unit = solved.shapes.col(i);  // phi^T M phi = 1
    const Eigen::MatrixXd floors = floor_motion(s, unit);
    const double factor = scale(s, floors, unit);
    const Eigen::Vector3d along = load.transpose() * unit;
    Mode mode;
    mode.period = w > 0 ? 2 * M_PI / w : std::numeric_limits<double>::infinity();
    mode.damping_ratio = w > 0 ? unit.dot(damping * unit) / (2 * w) + unformed : 0;
    mode.effective_mass = along.cwiseAbs2();
    mode.participation = along / factor;
    mode.shape = factor * floors;
    mode.unknowns = factor * unit;
    found.push_back(std::move(mode));
  }
  return found;
}

std::vector<double> damping_ratios(const Structure& s) {
  std::vector<double> ratios;
  if (s.is_rigid() || s.is_free) return ratios;
  if (s.damping.norm() == 0) {
    for (const double w : s.frequencies) ratios.push_back(s.by_mass / (2 * w) + s.by_stiffness * w / 2 + s.modal_ratio);
    return ratios;
  }
  if (s.size() > max_for_ratios) return ratios;
  const int count = static_cast<int>(s.frequencies.size()) + s.rigid_motions;
  for (const Mode& mode : modes(s, count)) ratios.push_back(mode.damping_ratio);
  ratios.erase(ratios.begin(), ratios.begin() + s.rigid_motions);
  return ratios;
}

namespace {

std::string floor_shape(const Mode& mode) {
  std::string text;
  for (int i = 0; i < mode.shape.rows(); ++i) {
    text += i == 0 ? " " : mode.shape.cols() > 1 ? "  " : " ";
    for (int j = 0; j < mode.shape.cols(); ++j) text += fmt::format("{}{:.4f}", j == 0 ? "" : ",", mode.shape(i, j));
  }
  return text;
}

// Replaces round-off by zero.
double without_sign_of_zero(double value) { return std::abs(value) < 5e-6 ? 0.0 : value; }

std::string table_along_x(const std::vector<Mode>& found, double total) {
  std::string text =
      "mode   period (s)  frequency (Hz)  damping (%)  participation  effective mass (%)  shape from the ground up\n";
  int number = 0;
  double sum = 0;
  for (const Mode& mode : found) {
    sum += mode.effective_mass[0];
    text += fmt::format("{:>4}  {:>11.6f}  {:>14.6f}  {:>11.4f}  {:>13.5f}  {:>18.3f} {}\n", ++number, mode.period,
                        1 / mode.period, 100 * mode.damping_ratio, mode.participation[0],
                        100 * mode.effective_mass[0] / total, floor_shape(mode));
  }
  return text + fmt::format("effective masses add up to {:.3f} % of {:.6g} t\n\n", 100 * sum / total, total / 1e3);
}

std::string table_of_frame(const Structure& s, const std::vector<Mode>& found) {
  const std::vector<int> along = s.dimension == 3 ? std::vector{0, 1, 2} : std::vector{0, 2};
  const Eigen::Vector3d total = s.total_mass();
  std::string text = "mode   period (s)  frequency (Hz)  damping (%)";
  for (const int j : along) text += fmt::format("  participation {}  effective mass {} (%)", axes[j], axes[j]);
  text += '\n';
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int number = 0;
  for (const Mode& mode : found) {
    sum += mode.effective_mass;
    text += fmt::format("{:>4}  {:>11.6f}  {:>14.6f}  {:>11.4f}", ++number, mode.period, 1 / mode.period,
                        100 * mode.damping_ratio);
    for (const int j : along)
      text += fmt::format("  {:>15.5f}  {:>20.3f}", without_sign_of_zero(mode.participation[j]),
                          total[j] > 0 ? 100 * mode.effective_mass[j] / total[j] : 0.0);
    text += '\n';
  }
  text += "effective masses add up to";
  for (const int j : along)
    text +=
        fmt::format("{} {:.3f} % along {}", j == 0 ? "" : ",", total[j] > 0 ? 100 * sum[j] / total[j] : 0.0, axes[j]);
  return text + fmt::format(" of {:.6g} t\n\n", total[0] / 1e3);
}

Json geometry_json(const Structure& s) {
  Json nodes = Json::array();
  for (const Eigen::Vector3d& p : s.geometry.positions) nodes.push_back({p.x(), p.y(), p.z()});
  return {{"dimension", s.dimension}, {"nodes", nodes}, {"members", s.geometry.members}};
}

Json node_shapes_json(const Structure& s, const std::vector<Mode>& found) {
  Json shapes = Json::array();
  for (const Mode& mode : found) {
    const Eigen::MatrixX3d moved = s.node_translations(mode.unknowns);
    Json nodes = Json::array();
    for (int i = 0; i < moved.rows(); ++i) nodes.push_back({moved(i, 0), moved(i, 1), moved(i, 2)});
    shapes.push_back(std::move(nodes));
  }
  return shapes;
}

Json elevations_json(const Structure& s) {
  Json all = Json::array();
  for (const Floor& floor : s.floors) all.push_back(floor.elevation ? Json(*floor.elevation) : Json(nullptr));
  return all;
}

Json mode_json(const Structure& s, const Mode& mode) {
  const auto list = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
  Json one = Json::object();
  one["period"] = mode.period;
  one["damping_ratio"] = mode.damping_ratio;
  if (along_x_only(s)) {
    one["participation"] = mode.participation[0];
    one["effective_mass"] = mode.effective_mass[0];
    one["shape"] = list(mode.shape.col(0));
    return one;
  }
  one["participation"] = list(mode.participation);
  one["effective_mass"] = list(mode.effective_mass);
  one["shape"] = Json::array();
  for (int i = 0; i < mode.shape.rows(); ++i) one["shape"].push_back(list(mode.shape.row(i)));
  return one;
}

}  // namespace

std::string modes_table(const Model& model, int max_count, const ModeSolver& solver) {
  std::string text;
  for (const Structure& s : model.structures) {
    if (s.is_rigid()) continue;
    const double total = s.total_mass()[0];
    text += fmt::format("{} ({}, {} floor{}, {:.6g} t, damping: {})\n", s.name, s.kind, s.floors.size(),
                        s.floors.size() == 1 ? "" : "s", total / 1e3, s.damping_note);
    const std::vector<Mode> found = modes(s, count_of(s, max_count), solver);
    text += along_x_only(s) ? table_along_x(found, total) : table_of_frame(s, found);
  }
  return text;
}

std::string modes_json(const Model& model, int max_count, const ModeSolver& solver, bool for_pictures) {
  Json all = Json::object(), geometry = Json::object(), shapes = Json::object(), elevations = Json::object();
  for (const Structure& s : model.structures) {
    const std::vector<Mode> found = modes(s, count_of(s, max_count), solver);
    Json list = Json::array();
    for (const Mode& mode : found) list.push_back(mode_json(s, mode));
    all[s.name] = std::move(list);
    if (!for_pictures) continue;
    elevations[s.name] = elevations_json(s);
    if (!s.node_translations) continue;
    geometry[s.name] = geometry_json(s);
    shapes[s.name] = node_shapes_json(s, found);
  }
  if (!for_pictures) return all.dump();
  return Json{{"modes", all}, {"geometry", geometry}, {"node_shapes", shapes}, {"elevations", elevations}}.dump();
}

}  // namespace pounding
