#include <pounding/recording/frame_quantities.hpp>

#include <pounding/linear/column_sums.hpp>

namespace pounding {
namespace {

// Evaluates a quantity of a structure from its unknowns.
double value(const Row& row, const Eigen::VectorXd& unknowns) {
  double sum = 0;
  for (Row::InnerIterator it(row); it; ++it) sum += it.value() * unknowns[it.index()];
  return sum;
}

// Calls visit(number, row) for the rows of nodes.
template <class Visit>
Eigen::Index visit_nodes(const Structure& s, Visit&& visit) {
  Eigen::Index count = 0;
  for (const std::vector<Row>& node : s.nodes.motion)
    for (const Row& row : node) visit(count++, row);
  return count;
}

template <class Visit>
Eigen::Index visit_shears(const Structure& s, Visit&& visit) {
  Eigen::Index count = 0;
  for (const Floor& floor : s.floors)
    for (const Row& row : floor.storey_shear) visit(count++, row);
  return count;
}

constexpr auto nothing = [](Eigen::Index, const Row&) {};

}  // namespace

std::vector<int> reported_forces(const Structure& s) {
  std::vector<int> rows;
  const int components = static_cast<int>(s.forces.components.size());
  for (const int member : s.reported_members)
    for (int j = 0; j < components; ++j) rows.push_back(member * components + j);
  for (int row = static_cast<int>(s.forces.members.size()) * components; row < s.forces.rows.rows(); ++row)
    rows.push_back(row);
  return rows;
}

FrameQuantities frame_quantities(const Structure& s, const std::vector<int>& reported, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& a) {
  FrameQuantities made;
  made.displacement.resize(visit_nodes(s, nothing));
  made.velocity = made.acceleration = made.displacement;
  visit_nodes(s, [&](Eigen::Index i, const Row& row) {
    made.displacement[i] = value(row, u);
    made.velocity[i] = value(row, v);
    made.acceleration[i] = value(row, a);
  });
  made.shears.resize(visit_shears(s, nothing));
  visit_shears(s, [&](Eigen::Index i, const Row& row) { made.shears[i] = value(row, u); });
  made.forces.setZero(static_cast<Eigen::Index>(reported.size()));
  for (std::size_t i = 0; i < reported.size(); ++i)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(s.forces.rows, reported[i]); it; ++it)
      made.forces[static_cast<Eigen::Index>(i)] += it.value() * u[it.index()];
  return made;
}

FrameRows::FrameRows(const Structure& s, const std::vector<int>& reported, const StructureSolver::Segment& modes)
    : first_(modes.first) {
  const Eigen::MatrixXd& shapes = modes.modes->shapes;
  const Eigen::Index count = shapes.cols();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(s.size());
  at_rest_ = frame_quantities(s, reported, s.at_rest.size() > 0 ? s.at_rest : none, none, none);
  nodes_.resize(at_rest_.displacement.size(), count);
  others_.resize(at_rest_.shears.size() + at_rest_.forces.size(), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const FrameQuantities of_mode = frame_quantities(s, reported, shapes.col(j), none, none);
    nodes_.col(j) = of_mode.displacement;
    others_.col(j) << of_mode.shears, of_mode.forces;
  }
}

FrameQuantities FrameRows::at(const Eigen::MatrixXd& coordinates) const {
  const auto product = [&](const Eigen::MatrixXd& rows, Eigen::Index columns) {
    Eigen::MatrixXd made = Eigen::MatrixXd::Zero(rows.rows(), columns);
    add_products({rows.data(), rows.rows(), rows.cols(), rows.rows()},
                 {coordinates.data() + first_, rows.cols(), columns, coordinates.rows()}, made.data(), made.rows());
    return made;
  };
  const Eigen::MatrixXd nodes = product(nodes_, 3), others = product(others_, 1);
  return {at_rest_.displacement + nodes.col(0), nodes.col(1), nodes.col(2),
          at_rest_.shears + others.col(0).head(at_rest_.shears.size()),
          at_rest_.forces + others.col(0).tail(at_rest_.forces.size())};
}

}  // namespace pounding
