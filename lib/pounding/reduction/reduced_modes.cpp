#include <pounding/reduction/reduced_modes.hpp>

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <pounding/core/error.hpp>
#include <pounding/linear/all_modes.hpp>
#include <pounding/linear/dense_products.hpp>
#include <pounding/linear/factor.hpp>

namespace pounding::petsc {
namespace {

constexpr const char* factor_prefix = "pounding_red_factor_";
// Unit columns whose component orthogonal to the other directions of their chain, or of the joined basis, is smaller
// than this are round-off.
constexpr double nothing_new = 1e-9, nothing_joined = 1e-12;
// Initial vectors whose component outside the basis is smaller than this are considered to lie in it.
constexpr double in_the_span = 1e-10;

Eigen::MatrixXd beside(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right) {
  if (left.size() == 0) return right;
  if (right.size() == 0) return left;
  Eigen::MatrixXd both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

// Nonzero columns, scaled to unit length.
Eigen::MatrixXd unit_columns(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd kept(x.rows(), x.cols());
  Eigen::Index count = 0;
  for (const auto column : x.colwise())
    if (const double length = column.stableNorm(); length > 0) kept.col(count++) = column / length;
  kept.conservativeResize(Eigen::NoChange, count);
  return kept;
}

// Orthonormal basis of the columns; directions below `minimum` are dropped.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& x, double minimum) {
  if (x.cols() == 0) return x;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
  const Eigen::Index maximum = std::min(x.rows(), x.cols());
  Eigen::Index rank = 0;
  while (rank < maximum && std::abs(qr.matrixQR()(rank, rank)) > minimum) ++rank;
  Eigen::MatrixXd q = Eigen::MatrixXd::Identity(x.rows(), rank);
  q.applyOnTheLeft(qr.householderQ());
  return q;
}

void require_rows(const SparseMatrix& stiffness, const ReducedInputs& inputs) {
  for (const Eigen::MatrixXd* input : {&inputs.links, &inputs.parts, &inputs.ground, &inputs.starts})
    if (input->size() > 0 && input->rows() != stiffness.rows())
      throw std::invalid_argument("an input of a reduced structure has the wrong number of rows");
}

bool same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a == b;
}

struct Ritz {
  Eigen::VectorXd squares;
  Eigen::MatrixXd vectors;
};

Ritz ritz_of(const Eigen::MatrixXd& stiffness) {
  Eigenpairs found = eigenpairs_of(stiffness);
  return {found.values.cwiseMax(0), std::move(found.vectors)};
}

// Blocks of one chain, mutually orthonormal; first() concatenates the first `count` of them.
struct Chain {
  std::vector<Eigen::MatrixXd> blocks;
  bool ended = false;

  Eigen::MatrixXd first(int count) const {
    Eigen::MatrixXd all;
    for (int k = 0; k < std::min<int>(count, static_cast<int>(blocks.size())); ++k) all = beside(all, blocks[k]);
    return all;
  }
  // Adds the component of new columns orthogonal to all blocks. Orthogonalizes twice: round-off of the first pass is as
  // large as the remainder; after normalization, the second pass leaves round-off of unit vectors.
  void add(const Eigen::MatrixXd& columns, double minimum = nothing_new) {
    Eigen::MatrixXd next = orthonormal(without(unit_columns(columns)), minimum);
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

// Orthonormal basis of all parts, each with orthonormal columns, and of the initial vectors, in this order. It starts
// with the first part unchanged.
Eigen::MatrixXd joined(const std::vector<Eigen::MatrixXd>& parts, const Eigen::MatrixXd& starts) {
  Chain all;
  for (const Eigen::MatrixXd& part : parts) {
    if (part.cols() == 0) continue;
    if (all.blocks.empty())
      all.blocks.push_back(part);
    else
      all.add(part, nothing_joined);
  }
  if (starts.cols() > 0) all.add(starts, in_the_span);
  return all.first(static_cast<int>(all.blocks.size()));
}

}  // namespace

bool ReducedInputs::operator==(const ReducedInputs& other) const {
  return shift == other.shift && same(links, other.links) && same(parts, other.parts) && same(ground, other.ground) &&
         same(starts, other.starts);
}

// The structure in the coordinates y = L^T u of its dynamic degrees of freedom, M = L L^T, in which mass-normalised
// vectors are orthonormal.
struct ReducedModes::Structure {
  MassSplit dofs;
  SparseMatrix mass, stiffness;
  Eigen::SimplicialLLT<SparseMatrix> root;  // of M on the dynamic degrees of freedom
  SparseMatrix spread;                      // L, extended to all unknowns
  std::optional<Factor> factor, massless;
  SparseMatrix coupling;  // K between dynamic and massless degrees of freedom
  ReducedInputs inputs;
  Chain links, yielding, ground;
  std::optional<Eigen::MatrixXd> shifted;
  std::optional<std::pair<double, Factor>> contact_factor;  // of K + shift M

  Structure(const SparseMatrix& m, const SparseMatrix& k, const ReducedInputs& of)
      : dofs(split_by_mass(m)), mass(m), stiffness(k), inputs(of) {
    require_rows(k, inputs);
    root.compute(submatrix(mass, dofs.dynamic, dofs.dynamic));
    if (root.info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
    SparseMatrix at(mass.rows(), static_cast<int>(dofs.dynamic.size()));
    for (std::size_t i = 0; i < dofs.dynamic.size(); ++i) at.insert(dofs.dynamic[i], static_cast<int>(i)) = 1;
    spread = at * SparseMatrix(root.permutationPinv() * SparseMatrix(root.matrixL()));
    stiffness.makeCompressed();
    factor.emplace(PETSC_COMM_SELF, pattern_of(stiffness), values_of(stiffness), factor_prefix);
    if (!factor->ok())
      throw std::invalid_argument("the stiffness is singular or indefinite: the structure is unsupported or buckles");
    if (dofs.massless.empty()) return;
    SparseMatrix own = submatrix(stiffness, dofs.massless, dofs.massless);
    own.makeCompressed();
    massless.emplace(PETSC_COMM_SELF, pattern_of(own), values_of(own), factor_prefix);
    if (!massless->ok()) throw std::invalid_argument("a massless degree of freedom has no stiffness");
    coupling = submatrix(stiffness, dofs.massless, dofs.dynamic);
  }

  static Eigen::MatrixXd solve(const Factor& by, const Eigen::MatrixXd& load) {
    Eigen::MatrixXd x;
    if (load.cols() > 0 && !by.solve(load, x)) throw SolverError("a solve for the modes of a reduced structure failed");
    return x;
  }
  // Static responses to these loads, in the coordinates y.
  Eigen::MatrixXd answers(const Factor& by, const Eigen::MatrixXd& load) const {
    return spread.transpose() * solve(by, load);
  }

  void grow(Chain& chain, const Eigen::MatrixXd& input, int count) {
    while (static_cast<int>(chain.blocks.size()) < count && !chain.ended) {
      const Eigen::MatrixXd load =
          chain.blocks.empty() ? unit_columns(input) : Eigen::MatrixXd(spread * chain.blocks.back());
      if (load.cols() == 0)
        chain.ended = true;
      else
        chain.add(answers(*factor, load));
    }
  }

  const Factor& factor_at(double shift) {
    if (contact_factor && contact_factor->first == shift) return contact_factor->second;
    SparseMatrix a = stiffness + shift * mass;
    a.makeCompressed();
    contact_factor.emplace(shift, Factor(PETSC_COMM_SELF, pattern_of(a), values_of(a), factor_prefix));
    if (!contact_factor->second.ok())
      throw SolverError(
          "the shifted stiffness of a reduced structure could not be factored at the frequency of its contacts");
    return contact_factor->second;
  }

  const Eigen::MatrixXd& at_the_contact() {
    if (shifted) return *shifted;
    shifted.emplace();
    const Eigen::MatrixXd load = unit_columns(inputs.links);
    if (inputs.shift > 0 && load.cols() > 0)
      shifted = orthonormal(unit_columns(answers(factor_at(inputs.shift), load)), nothing_new);
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

  // Modes of a depth, reused by its counts and its shadow: shapes are displacements(basis * vectors).
  struct Made {
    ReducedDepth depth;
    Eigen::MatrixXd basis;
    Ritz ritz{};
  };
  std::optional<Made> made;

  Made& basis(const ReducedDepth& depth) {
    if (made && made->depth == depth) return *made;
    const std::vector<Eigen::MatrixXd> chains = parts(depth);
    return made.emplace(Made{depth, joined(chains, starts_beside(chains))});
  }

  // The chains and the block at the contact frequency.
  std::vector<Eigen::MatrixXd> parts(const ReducedDepth& depth) {
    grow(links, inputs.links, depth.links);
    grow(yielding, inputs.parts, depth.parts);
    grow(ground, inputs.ground, depth.ground);
    return {links.first(depth.links), ground.first(depth.ground), depth.shifted ? at_the_contact() : Eigen::MatrixXd(),
            yielding.first(depth.parts)};
  }

  // At unit length. A structure without any input still gets one coordinate.
  Eigen::MatrixXd starts_beside(const std::vector<Eigen::MatrixXd>& chains) const {
    Eigen::MatrixXd given;
    if (inputs.starts.size() > 0) given = unit_columns(spread.transpose() * inputs.starts);
    if (given.cols() == 0 && std::ranges::all_of(chains, [](const Eigen::MatrixXd& part) { return part.cols() == 0; }))
      given = unit_columns(answers(*factor, spread * Eigen::VectorXd::Ones(spread.cols())));
    return given;
  }

  // The basis of depth `less`, in coordinates of the basis of `depth`.
  Eigen::MatrixXd less_basis(const ReducedDepth& depth, const ReducedDepth& less) {
    const Eigen::MatrixXd& whole = basis(depth).basis;
    const std::vector<Eigen::MatrixXd> chains = parts(less);
    std::vector<Eigen::MatrixXd> inside;
    bool is_head = true;
    for (const Eigen::MatrixXd& part : chains) {
      if (part.cols() == 0) continue;
      inside.push_back(is_head ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(whole.cols(), part.cols()))
                               : transposed_product(whole, part));
      is_head = false;
    }
    return joined(inside, transposed_product(whole, starts_beside(chains)));
  }

  GroupModes modes(const ReducedDepth& depth) {
    Made& of = basis(depth);
    GroupModes found;
    found.shapes = displacements(of.basis);
    const Eigen::MatrixXd forces = stiffness * found.shapes;
    of.ritz = ritz_of(symmetric_product(found.shapes, forces));
    found.squares = of.ritz.squares;
    found.shapes = product(found.shapes, of.ritz.vectors);
    for (Eigen::Index j = 0; j < found.shapes.cols(); ++j) {
      Eigen::Index largest = 0;
      found.shapes.col(j).cwiseAbs().maxCoeff(&largest);
      if (found.shapes(largest, j) >= 0) continue;
      found.shapes.col(j) = -found.shapes.col(j);
      of.ritz.vectors.col(j) = -of.ritz.vectors.col(j);
    }
    return found;
  }

  // L^-1 f on the dynamic degrees of freedom; loads on massless ones are condensed statically.
  Eigen::MatrixXd turned(const Eigen::MatrixXd& loads) const {
    Eigen::MatrixXd own = loads(dofs.dynamic, Eigen::all);
    if (massless)
      if (const Eigen::MatrixXd light = loads(dofs.massless, Eigen::all); !light.isZero(0))
        own -= coupling.transpose() * solve(*massless, light);
    return root.matrixL().solve(Eigen::MatrixXd(root.permutationP() * own));
  }

  FurtherDirections further(const ReducedDepth& depth) {
    if (basis(depth).ritz.squares.size() == 0) modes(depth);
    const Made& of = *made;
    const auto in_modes = [&](const Eigen::MatrixXd& loads) {
      return transposed_product(of.ritz.vectors, transposed_product(of.basis, loads));
    };
    const Eigen::MatrixXd columns = turned(inputs.links);
    FurtherDirections found{
        .squares = of.ritz.squares, .links = in_modes(columns), .coupling = {}, .own = {}, .further_links = {}};
    grow(links, inputs.links, depth.links + 1);
    if (static_cast<int>(links.blocks.size()) <= depth.links) return found;
    Chain both;
    both.blocks.push_back(of.basis);
    both.add(links.blocks[static_cast<std::size_t>(depth.links)], nothing_joined);
    if (both.ended) return found;
    const Eigen::MatrixXd& beside = both.blocks.back();
    const Eigen::MatrixXd forces = turned(stiffness * displacements(beside));
    found.coupling = in_modes(forces);
    found.own = symmetric_product(beside, forces);
    found.further_links = transposed_product(beside, columns);
    return found;
  }

  ShadowModes shadow(const ReducedDepth& depth, const ReducedDepth& less) {
    if (basis(depth).ritz.squares.size() == 0) modes(depth);
    const Eigen::MatrixXd inside = less_basis(depth, less);
    const Ritz& of = made->ritz;
    const Eigen::MatrixXd columns = transposed_product(of.vectors, inside);
    const Ritz found = ritz_of(symmetric_product(columns, of.squares.asDiagonal() * columns));
    return {product(columns, found.vectors), found.squares};
  }
};

ReducedModes::ReducedModes(const SparseMatrix& mass, const SparseMatrix& stiffness, const ReducedInputs& inputs)
    : structure_(std::make_unique<Structure>(mass, stiffness, inputs)) {}
ReducedModes::~ReducedModes() = default;
ReducedModes::ReducedModes(ReducedModes&&) noexcept = default;

void ReducedModes::drive(const ReducedInputs& inputs) {
  Structure& s = *structure_;
  require_rows(s.stiffness, inputs);
  if (inputs == s.inputs) return;
  const bool same_links = same(inputs.links, s.inputs.links);
  if (!same_links) s.links = {};
  if (!same(inputs.parts, s.inputs.parts)) s.yielding = {};
  if (!same(inputs.ground, s.inputs.ground)) s.ground = {};
  if (!same_links || inputs.shift != s.inputs.shift) s.shifted.reset();
  s.inputs = inputs;
  s.made.reset();
}

int ReducedModes::maximum() const { return static_cast<int>(structure_->dofs.dynamic.size()); }
int ReducedModes::count(const ReducedDepth& depth) { return static_cast<int>(structure_->basis(depth).basis.cols()); }
int ReducedModes::count(const ReducedDepth& depth, const ReducedDepth& less) {
  return static_cast<int>(structure_->less_basis(depth, less).cols());
}
GroupModes ReducedModes::modes(const ReducedDepth& depth) { return structure_->modes(depth); }
FurtherDirections ReducedModes::further(const ReducedDepth& depth) { return structure_->further(depth); }
ShadowModes ReducedModes::shadow(const ReducedDepth& depth, const ReducedDepth& less) {
  return structure_->shadow(depth, less);
}

}  // namespace pounding::petsc
