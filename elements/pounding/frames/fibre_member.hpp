#pragma once
/// A beam-column of fibres: sections at points of its axis, formulated by forces or by displacements. SI units.

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <pounding/core/archive.hpp>
#include <pounding/frames/beam.hpp>
#include <pounding/frames/corotation.hpp>
#include <pounding/frames/frame_model.hpp>
#include <pounding/frames/integration_rule.hpp>
#include <pounding/sections/fibre_section.hpp>

namespace pounding {

/// Interpolation along the member: of forces, exact for nodal loads, or of displacements, by cubic polynomials.
enum class MemberFormulation { force, displacement };

/// Rule, formulation and geometry of a fibre member, and its elastic stiffnesses.
struct FibreMemberOptions {
  IntegrationRule rule = lobatto(5);
  MemberFormulation formulation = MemberFormulation::force;
  /// p_delta: the constant axial force at rest N acts on the inclined chord, with the potential N t^2/(2 L) of the
  /// transverse relative displacement t. corotational: large rotations and small deformations, see Corotation.
  FrameGeometry geometry = FrameGeometry::linear;
  double axial_force = 0;  ///< at rest, for p_delta; tension > 0 [N]
  /// G As along local y and z [N]; only the formulation by forces has shear deformation.
  double shear_stiffness_y = std::numeric_limits<double>::infinity();
  double shear_stiffness_z = std::numeric_limits<double>::infinity();
  double torsion_stiffness = 0;  ///< G J, in space > 0 [N m^2]
};

/// A straight member of equal fibre sections. Immutable: accepted states and iterates are values.
///
/// Basic deformations v: elongation; rotations of start and end relative to the chord, about local y and, in space,
/// about local z; twist. Basic forces q are conjugate to them. Shear and torsion are elastic and uncoupled.
///
/// By forces (Spacone, Ciampi & Filippou 1996; Neuenhofer & Filippou 1997, J. Struct. Eng. 123(7), 958-966): q and the
/// section deformations e are unknowns of the same Newton iteration as the displacements. With section forces s = b q,
/// flexibilities f and weights w, residuals are r = b q - s(e) at each section and r_v = v - sum w b^T e, and
///
///     F = sum w b^T f b,  G = F^-1,  g = r_v - sum w b^T f r
///     dq = G (g + dv),  de = f (b dq + r)
///     forces A^T (q + G g),  tangent A^T G A + K_geo,  A = dv/du
///
/// Steps beyond a strain of 0.003 are shortened. A singular section, and a softening one if the iteration converges
/// slowly, has a bounded positive flexibility instead, so that a member whose force jumps at fixed displacements, as
/// softening ones can, finds a state. Residuals remain exact.
///
/// By displacements: e = a v, q = sum w a^T s(e); there are no inner unknowns.
class FibreMember {
 public:
  /// Basic forces [N], [N m] or deformations [m], [rad]; in the plane, the first three.
  using Basic = std::array<double, 6>;

  /// Accepted state.
  struct State {
    std::vector<sections::FibreStates> fibres;        ///< of each section
    std::vector<sections::Deformation> deformations;  ///< of each section
    Basic forces{}, basic_deformations{};
    double work = 0;            ///< of the section forces since the undeformed state [J]
    double largest_strain = 0;  ///< of any fibre so far [-]

    /// Reads into a state of the same member.
    void archive(Archive& archive);
  };

  /// Basic forces and section deformations of an iteration, with their linearization, and the stages of a step.
  struct Iterate {
    struct Section {
      sections::Deformation deformation{};
      std::array<double, 3> change{};                         ///< of the deformation in the last iteration
      std::array<double, 3> residual{};                       ///< r, of equilibrium
      Eigen::Matrix3d flexibility = Eigen::Matrix3d::Zero();  ///< f
    };
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    Vector6 forces = Vector6::Zero();        ///< q
    Vector6 deformations = Vector6::Zero();  ///< v
    Vector6 residual = Vector6::Zero();      ///< g
    Matrix6 stiffness = Matrix6::Zero();     ///< G
    std::vector<Section> sections;
    double change = 0;  ///< of section strains in the last iteration
    int slow = 0;       ///< iterations of this stage since one that halved the change, or since slow convergence
    std::vector<double> times;                  ///< of recorded stages, since the beginning of the step
    std::vector<sections::Deformation> stages;  ///< section deformations, stage by stage

    /// Without stages. Reads into an iterate of the same member after begin().
    void archive(Archive& archive);
    /// Basic forces at which the linearized residuals are zero.
    Vector6 linearized_forces() const { return forces + stiffness * residual; }
  };

  /// `options` gives orientation and rigid offsets; a fibre member has neither releases nor a mass, and its axial
  /// force at rest is in `fibres`. dimension 2: only ux, uz and ry of the nodes are used. Throws std::invalid_argument
  /// like Beam, for an invalid rule or stiffness, and for a section without initial bending stiffness.
  FibreMember(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const BeamOptions& options,
              std::shared_ptr<const sections::FibreSection> section, FibreMemberOptions fibres, int dimension);

  State undeformed() const;
  /// Starts an iteration at an accepted state, without stages. Evaluates each section.
  void begin(const State& state, Iterate& iterate) const;
  /// One Newton iteration: updates the iterate for these displacements of the nodes, evaluates each section, and sets
  /// the forces on the nodes and the tangent, in global axes. Returns the change of section strains in this iteration
  /// (not shortened) [-]; once it is zero, results depend on state and displacements only.
  double linearize(const State& state, Iterate& iterate, const Vector12& displacements, Vector12& force,
                   Matrix12& tangent) const;
  /// Updates the iterate for these displacements by its last linearization, without evaluating the sections. Returns
  /// the change of section strains [-].
  double update(Iterate& iterate, const Vector12& displacements) const;
  /// Records the iterate as a stage of the step. `time` is that since begin(), in any unit, and positive; the accepted
  /// state at time 0 needs no record. Throws std::invalid_argument for another time.
  void record_stage(Iterate& iterate, double time) const;
  /// Accepts the iterate as the end of a step. If at least two stages are recorded, fibres follow reversals inside the
  /// step of at least this strain; true if any did. The iterate must begin() again.
  bool accept(State& state, const Iterate& iterate, double min_reversal) const;

  /// Recoverable energy [J], without potential().
  double stored(const State& state) const;
  /// Energy dissipated since the undeformed state [J].
  double dissipated(const State& state) const { return dissipated(state, stored(state)); }
  /// The same, from the stored energy [J].
  double dissipated(const State& state, double stored) const;
  /// Potential of the axial force at rest, for p_delta [J].
  double potential(const Vector12& displacements) const;
  /// Largest strain of a fibre so far [-].
  double largest_strain(const State& state) const { return state.largest_strain; }
  /// Forces and moments on both ends for basic forces [N], [N m], in local axes, which rotate with the chord if
  /// corotational.
  Vector12 end_forces(const Iterate::Vector6& forces, const Vector12& displacements) const;
  /// Forces on the nodes, global axes.
  Vector12 nodal_forces(const Iterate::Vector6& forces, const Vector12& displacements) const;
  /// Tangent of the undeformed state without axial force at rest, global axes.
  Matrix12 initial_stiffness() const;

  double length() const { return length_; }  ///< between the ends of the offsets [m]
  const IntegrationRule& rule() const { return options_.rule; }
  const sections::FibreSection& section() const { return *section_; }

 private:
  using Interpolation = Eigen::Matrix<double, 3, 6>;  // of a section: b or a
  template <int section_size>
  double linearize_in(const State& state, Iterate& iterate, const Vector12& displacements, Vector12& force,
                      Matrix12& tangent) const;
  template <int section_size>
  void evaluate(const State& state, Iterate& iterate) const;
  template <int section_size>
  double correct(Iterate& iterate, const Iterate::Vector6& deformations) const;
  Iterate::Vector6 basic_deformations(const Vector12& displacements) const;
  Interpolation interpolation(double at) const;

  std::shared_ptr<const sections::FibreSection> section_;
  FibreMemberOptions options_;
  bool is_plane_;
  double length_;
  std::array<double, 3> scale_;        // strain per section deformation: 1, half depth, half width
  std::vector<Interpolation> shapes_;  // of each section
  std::vector<double> weights_;        // times the length
  Matrix6 elastic_flexibility_;        // of elastic points, shear and torsion
  double initial_determinant_;         // of the section stiffness
  Eigen::Matrix3d initial_section_;    // stiffness
  Matrix12 to_local_;                  // displacements of the nodes, global -> of the ends, local
  // Small displacements. In the plane the first three rows and six columns, for ux, uz, ry of both nodes.
  Eigen::Matrix<double, 6, 12> to_basic_;
  Matrix12 geometric_;
  std::optional<Corotation> corotation_;
};

}  // namespace pounding
