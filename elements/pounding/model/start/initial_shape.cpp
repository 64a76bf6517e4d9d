#include <pounding/model/start/start.hpp>

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace pounding {
namespace {

// Relative threshold below which a direction is linearly dependent on the others.
constexpr double dependent = 1e-10;

bool moves_mass(const Structure& s, const Row& row) {
  for (Row::InnerIterator it(row); it; ++it)
    if (it.value() != 0 && has_mass(s.mass, static_cast<int>(it.index()))) return true;
  return false;
}

// q = K^-1 R^T f with R q = d, the shape of minimum strain energy; plus the displacements due to yielding.
Eigen::VectorXd held_shape(const Structure& s, const std::vector<Row>& rows, const Eigen::VectorXd& displacements) {
  if (s.rigid_motions > 0)
    throw std::invalid_argument(
        "a frame without supports cannot be held in a shape; remove it, or give an initial_velocity");
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd directions(s.size(), count);
  for (Eigen::Index i = 0; i < count; ++i) directions.col(i) = rows[static_cast<std::size_t>(i)];
  const Eigen::SimplicialLDLT<SparseMatrix> stiffness(s.stiffness);
  const Eigen::MatrixXd by_forces = stiffness.solve(directions);
  const Eigen::MatrixXd flexibility = directions.transpose() * by_forces;
  // Rotations and translations have equal weight.
  const Eigen::VectorXd scale = flexibility.diagonal().cwiseSqrt().cwiseInverse();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(scale.asDiagonal() * flexibility * scale.asDiagonal());
  solver.setThreshold(dependent);
  if (solver.rank() < count)
    throw std::invalid_argument("two of the displacements are linearly dependent; keep one of them");
  const Eigen::VectorXd forces = scale.asDiagonal() * solver.solve(Eigen::VectorXd(scale.asDiagonal() * displacements));
  const Eigen::VectorXd shape = by_forces * forces;
  return shape + yielding_while_held(s, shape, rows);
}

}  // namespace

Eigen::VectorXd shape_of_floors(const Structure& frame, const std::vector<double>& displacements) {
  if (frame.floors.empty())
    throw std::invalid_argument(
        "the frame has no floors; type initial_node_displacements: {b: {ux: 5 mm}}, or give it floors");
  std::vector<Row> rows;
  for (const Floor& floor : frame.floors) {
    if (!moves_mass(frame, floor.motion.front()))
      throw std::invalid_argument(fmt::format(
          "floor {} follows a massless node, so the displacement would vanish immediately; give the node a mass, or "
          "let the floor be rigid",
          floor.label));
    rows.push_back(floor.motion.front());
  }
  return held_shape(
      frame, rows,
      Eigen::Map<const Eigen::VectorXd>(displacements.data(), static_cast<Eigen::Index>(displacements.size())));
}

Eigen::VectorXd shape_of_nodes(const Structure& frame, const std::vector<NodeDisplacement>& displacements) {
  std::vector<Row> rows;
  Eigen::VectorXd values(displacements.size());
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    const auto& [node, dof, value] = displacements[i];
    Row row = frame.surface->displacement(node, dof);
    row.prune(0.0);
    if (row.nonZeros() == 0)
      throw std::invalid_argument(fmt::format("{} of node {} is fixed by the supports; remove it", dof, node));
    if (!moves_mass(frame, row))
      throw std::invalid_argument(fmt::format(
          "{} of node {} has no mass, so the displacement would vanish immediately; remove it, or give the node a mass",
          dof, node));
    rows.push_back(std::move(row));
    values[static_cast<Eigen::Index>(i)] = value;
  }
  return held_shape(frame, rows, values);
}

}  // namespace pounding
