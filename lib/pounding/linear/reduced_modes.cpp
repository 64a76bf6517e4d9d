#include <pounding/linear/reduced_modes.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <pounding/core/error.hpp>
#include <pounding/linear/column_sums.hpp>
#include <pounding/linear/factor.hpp>

namespace pounding::petsc {
namespace {

constexpr const char* factor_prefix = "pounding_red_factor_";
// Columns of unit length that keep less than this beside the other directions of their chain, or of the joined basis, are rounding.
constexpr double nothing_new = 1e-9, nothing_joined = 1e-12;
// Starts of which the basis leaves less than this are in it.
constexpr double in_the_span = 1e-10;

Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
  if (left.size() == 0) return right;
  if (right.size() == 0) return left;
  Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

// Columns that are not zero, at unit length.
Eigen::MatrixXd unit_columns(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd kept(x.rows(), x.cols());
  Eigen::Index count = 0;
  for (const auto column : x.colwise())
    if (const double length = column.stableNorm(); length > 0) kept.col(count++) = column / length;
  kept.conservativeResize(Eigen::NoChange, count);
  return kept;
}

// An orthonormal basis of columns; directions below `least` are dropped.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& x, double least) {
  if (x.cols() == 0) return x;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
  const Eigen::Index most = std::min(x.rows(), x.cols());
  Eigen::Index rank = 0;
  while (rank < most && std::abs(qr.matrixQR()(rank, rank)) > least) ++rank;
  Eigen::MatrixXd q = Eigen::MatrixXd::Identity(x.rows(), rank);
  q.applyOnTheLeft(qr.householderQ());
  return q;
}

// Blocks of one chain, orthonormal together, the first `count` of them beside each other.
struct Chain {
  std::vector<Eigen::MatrixXd> blocks;
  bool ended = false;

  Eigen::MatrixXd first(int count) const {
    Eigen::MatrixXd all;
    for (int k = 0; k < std::min<int>(count, static_cast<int>(blocks.size())); ++k) all = beside(all, blocks[k]);
    return all;
  }
  // The part of new columns that is orthogonal to all blocks. Twice, as rounding of the first pass is of the size of what is left;
  // at unit length again the second pass leaves rounding of unit vectors.
  void add(const Eigen::MatrixXd& columns, double least = nothing_new) {
    Eigen::MatrixXd next = orthonormal(without(unit_columns(columns)), least);
    if (!blocks.empty() && next.cols() > 0) next = orthonormal(without(next), 0.5);
    if (next.cols() == 0)
      ended = true;
    else
      blocks.push_back(std::move(next));
  }

 private:
  Eigen::MatrixXd without(Eigen::MatrixXd x) const {
    for (const Eigen::MatrixXd& block : blocks) x -= product(block, transposed_product(block, x));
    return x;
  }
};

}  // namespace

// The structure in the coordinates y = L^T u of its unknowns with mass, M = L L^T, in which mass-normal vectors are orthonormal.
struct ReducedModes::Structure {
  MassSplit dofs;
  SparseMatrix mass, stiffness;
  Eigen::SimplicialLLT<SparseMatrix> root;  // of M at the unknowns with mass
  SparseMatrix spread;                      // L, at all unknowns
  std::optional<Factor> factor, massless;
  SparseMatrix coupling;                    // K from the unknowns with mass to those without
  ReducedInputs inputs;
  Chain links, ground;
  std::optional<Eigen::MatrixXd> shifted;

  Structure(const SparseMatrix& m, const SparseMatrix& k, const ReducedInputs& of) : dofs(split_by_mass(m)), mass(m), stiffness(k), inputs(of) {
    for (const Eigen::MatrixXd* input : {&inputs.links, &inputs.ground, &inputs.starts})
      if (input->size() > 0 && input->rows() != k.rows()) throw std::invalid_argument("an input of a reduced structure has another number of rows");
    root.compute(submatrix(mass, dofs.dynamic, dofs.dynamic));
    if (root.info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
    SparseMatrix at(mass.rows(), static_cast<int>(dofs.dynamic.size()));
    for (std::size_t i = 0; i < dofs.dynamic.size(); ++i) at.insert(dofs.dynamic[i], static_cast<int>(i)) = 1;
    spread = at * SparseMatrix(root.permutationPinv() * SparseMatrix(root.matrixL()));
    stiffness.makeCompressed();
    factor.emplace(PETSC_COMM_SELF, pattern_of(stiffness), values_of(stiffness), factor_prefix);
    if (!factor->ok()) throw std::invalid_argument("the stiffness is singular or indefinite: nothing holds the structure, or it buckles");
    if (dofs.massless.empty()) return;
    SparseMatrix own = submatrix(stiffness, dofs.massless, dofs.massless);
    own.makeCompressed();
    massless.emplace(PETSC_COMM_SELF, pattern_of(own), values_of(own), factor_prefix);
    if (!massless->ok()) throw std::invalid_argument("the stiffness leaves an unknown without mass loose");
    coupling = submatrix(stiffness, dofs.massless, dofs.dynamic);
  }

  static Eigen::MatrixXd solve(const Factor& by, const Eigen::MatrixXd& load) {
    Eigen::MatrixXd x;
    if (load.cols() > 0 && !by.solve(load, x)) throw SolverError("a solve for the modes of a reduced structure failed");
    return x;
  }
  // y of the answers to these loads.
  Eigen::MatrixXd answers(const Factor& by, const Eigen::MatrixXd& load) const { return spread.transpose() * solve(by, load); }

  void grow(Chain& chain, const Eigen::MatrixXd& input, int count) {
    while (static_cast<int>(chain.blocks.size()) < count && !chain.ended) {
      const Eigen::MatrixXd load = chain.blocks.empty() ? unit_columns(input) : Eigen::MatrixXd(spread * chain.blocks.back());
      if (load.cols() == 0)
        chain.ended = true;
      else
        chain.add(answers(*factor, load));
    }
  }

  const Eigen::MatrixXd& at_the_contact() {
    if (shifted) return *shifted;
    shifted.emplace();
    const Eigen::MatrixXd load = unit_columns(inputs.links);
    if (inputs.shift > 0 && load.cols() > 0) {
      SparseMatrix a = stiffness + inputs.shift * mass;
      a.makeCompressed();
      const Factor at(PETSC_COMM_SELF, pattern_of(a), values_of(a), factor_prefix);
      if (!at.ok()) throw SolverError("the stiffness of a reduced structure could not be factored at the frequency of its contacts");
      shifted = orthonormal(unit_columns(answers(at, load)), nothing_new);
    }
    return *shifted;
  }

  // Displacements at all unknowns.
  Eigen::MatrixXd displacements(const Eigen::MatrixXd& y) const {
    const Eigen::MatrixXd turned = root.matrixU().solve(y);
    const Eigen::MatrixXd own = root.permutationPinv() * turned;
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(mass.rows(), y.cols());
    u(dofs.dynamic, Eigen::all) = own;
    if (massless) u(dofs.massless, Eigen::all) = solve(*massless, -(coupling * own));
    return u;
  }

  // The basis of a depth; it is asked for again when its modes are.
  const Eigen::MatrixXd& basis(const ReducedDepth& depth) {
    for (const auto& [of, made] : made_)
      if (of == depth) return made;
    if (made_.size() == kept_bases) made_.erase(made_.begin());
    return made_.emplace_back(depth, joined_basis(depth)).second;
  }

  static constexpr std::size_t kept_bases = 2;
  std::vector<std::pair<ReducedDepth, Eigen::MatrixXd>> made_;

  // The chains, joined, with the starts that they do not hold.
  Eigen::MatrixXd joined_basis(const ReducedDepth& depth) {
    grow(links, inputs.links, depth.links);
    grow(ground, inputs.ground, depth.ground);
    Chain joined;
    for (const Eigen::MatrixXd& part : {links.first(depth.links), ground.first(depth.ground), depth.shifted ? at_the_contact() : Eigen::MatrixXd()}) {
      if (part.cols() == 0) continue;
      if (joined.blocks.empty())
        joined.blocks.push_back(part);
      else
        joined.add(part, nothing_joined);
    }
    Eigen::MatrixXd starts;
    if (inputs.starts.size() > 0) starts = unit_columns(spread.transpose() * inputs.starts);
    // A structure that nothing moves has a coordinate still.
    if (starts.cols() == 0 && joined.blocks.empty())
      starts = unit_columns(answers(*factor, spread * Eigen::VectorXd::Ones(spread.cols())));
    if (starts.cols() > 0) joined.add(starts, in_the_span);
    return joined.first(static_cast<int>(joined.blocks.size()));
  }
};

ReducedModes::ReducedModes(const SparseMatrix& mass, const SparseMatrix& stiffness, const ReducedInputs& inputs)
    : structure_(std::make_unique<Structure>(mass, stiffness, inputs)) {}
ReducedModes::~ReducedModes() = default;
ReducedModes::ReducedModes(ReducedModes&&) noexcept = default;

int ReducedModes::count(const ReducedDepth& depth) { return static_cast<int>(structure_->basis(depth).cols()); }

int ReducedModes::most() const { return static_cast<int>(structure_->dofs.dynamic.size()); }

GroupModes ReducedModes::modes(const ReducedDepth& depth) {
  GroupModes made;
  made.shapes = structure_->displacements(structure_->basis(depth));
  const Eigen::MatrixXd forces = structure_->stiffness * made.shapes;
  const Eigen::MatrixXd k = symmetric_product(made.shapes, forces);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(k);
  if (ritz.info() != Eigen::Success) throw SolverError("the modes of a reduced structure could not be computed");
  made.squares = ritz.eigenvalues().cwiseMax(0);
  made.shapes = product(made.shapes, ritz.eigenvectors());
  for (auto shape : made.shapes.colwise()) {
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    if (shape[largest] < 0) shape = -shape;
  }
  return made;
}

}  // namespace pounding::petsc
