#include <pounding/structures/oscillators.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <pounding/structures/bilinear_spring.hpp>

namespace pounding {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0) || std::isinf(value)) throw std::invalid_argument(std::string(what) + " must be positive and finite");
}

// Floors above each other that move along x only: the unknowns themselves.
class FloorSurface final : public Surface {
 public:
  explicit FloorSurface(std::vector<double> masses) : masses_(std::move(masses)) {}

  ContactPoint floor(int floor, Side, double) const override {
    const int n = static_cast<int>(masses_.size());
    ContactPoint point;
    for (Row& row : point.motion) row.resize(n);
    point.motion[0].insert(floor) = 1;
    point.mass = masses_.at(floor);
    return point;
  }

 private:
  std::vector<double> masses_;
};

class WallSurface final : public Surface {
 public:
  ContactPoint floor(int, Side, double) const override {
    ContactPoint point;
    point.mass = std::numeric_limits<double>::infinity();
    return point;
  }
};

// Storeys from the ground up; a free mass has a stiffness of zero and no storey.
Structure make_stick(const std::vector<double>& masses, const std::vector<double>& stiffnesses, const std::vector<double>& heights) {
  const int n = static_cast<int>(masses.size());
  Structure s;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  const Eigen::VectorXd mass = Eigen::Map<const Eigen::VectorXd>(masses.data(), n);
  double elevation = 0;
  for (int i = 0; i < n; ++i) {
    Floor floor;
    floor.label = std::to_string(i + 1);
    floor.mass = masses[i];
    if (!heights.empty()) floor.elevation = elevation += heights[i];
    floor.motion.emplace_back(n).insert(i) = 1;
    s.unknowns.push_back("floor " + floor.label);
    if (!stiffnesses.empty()) {
      const double k = stiffnesses[i];
      stiffness(i, i) += k;
      Row& shear = floor.storey_shear.emplace_back(n);
      if (i > 0) {
        stiffness(i - 1, i - 1) += k;
        stiffness(i - 1, i) = stiffness(i, i - 1) = -k;
        shear.insert(i - 1) = -k;
      }
      shear.insert(i) = k;
    }
    s.floors.push_back(std::move(floor));
  }
  s.mass = SparseMatrix(Eigen::MatrixXd(mass.asDiagonal()).sparseView());
  s.stiffness = stiffness.sparseView();
  s.damping.resize(n, n);
  s.storey_stiffness = stiffnesses;
  Support ground;
  ground.influence = ground.load = Eigen::MatrixX3d::Zero(n, 3);
  ground.influence.col(0).setOnes();
  ground.load.col(0) = mass;
  s.supports.push_back(std::move(ground));
  s.initial_displacement = s.initial_velocity = Eigen::VectorXd::Zero(n);
  s.surface = std::make_shared<FloorSurface>(masses);
  return s;
}

}  // namespace

Structure make_body(double mass) {
  require_positive(mass, "mass");
  Structure s = make_stick({mass}, {}, {});
  s.kind = "body";
  s.damping_note = "none";
  s.is_free = true;
  s.frequencies = Eigen::VectorXd::Zero(1);
  return s;
}

Structure make_oscillator(double mass, double stiffness, double damping_ratio) {
  require_positive(mass, "mass");
  require_positive(stiffness, "stiffness");
  if (!(damping_ratio >= 0)) throw std::invalid_argument("damping must not be negative");
  Structure s = make_stick({mass}, {stiffness}, {});
  s.kind = "oscillator";
  if (damping_ratio > 0) s.damping.insert(0, 0) = 2 * damping_ratio * std::sqrt(stiffness * mass);
  return s;
}

Structure make_shear_building(const std::vector<double>& masses, const std::vector<double>& stiffnesses,
                              const std::vector<double>& heights) {
  if (masses.empty() || stiffnesses.size() != masses.size()) throw std::invalid_argument("one mass and one stiffness a storey");
  for (std::size_t i = 0; i < masses.size(); ++i) {
    require_positive(masses[i], "mass");
    require_positive(stiffnesses[i], "stiffness");
  }
  Structure s = make_stick(masses, stiffnesses, heights);
  s.kind = "shear_building";
  return s;
}

void let_storeys_yield(Structure& s, const std::vector<double>& yield_forces, const std::vector<double>& hardening) {
  const std::size_t storeys = s.storey_stiffness.size();
  if (yield_forces.size() != storeys || hardening.size() != storeys)
    throw std::invalid_argument("one yield force and one hardening a storey");
  s.yielding.clear();
  for (std::size_t i = 0; i < storeys; ++i)
    s.yielding.emplace_back(yield_forces[i], hardening[i],
                            std::make_unique<BilinearSpring>(BilinearSpring::Parameters{
                                .stiffness = s.storey_stiffness[i], .yield_force = yield_forces[i], .hardening = hardening[i]}));
}

Structure make_wall() {
  Structure s;
  s.kind = "wall";
  s.dimension = 3;
  s.damping_note = "rigid";
  s.supports.emplace_back();
  s.surface = std::make_shared<WallSurface>();
  return s;
}

}  // namespace pounding
