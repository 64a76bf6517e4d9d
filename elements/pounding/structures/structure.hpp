#pragma once
/// A structure: its matrices, floors, contact points and reported quantities.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/ground/components.hpp>
#include <pounding/structures/massless.hpp>
#include <pounding/structures/spring.hpp>
#include <pounding/structures/yield_limits.hpp>

namespace pounding {

class ElasticForces;
class TangentForces;

/// A quantity as factors of the unknowns.
using Row = Eigen::SparseVector<double>;

/// A yielding part of a structure, in parallel with its stiffness in K: a storey, or a hinge at the end of a member. Or
/// a device between two points, which K does not contain.
struct YieldingPart {
  /// The stiffness of a device is additional to K; that of the others is contained in K.
  enum class Kind { storey, hinge, isolator, device, support };
  /// Values of a hinge, for reports. Yield moments are magnitudes.
  struct Hinge {
    bool is_rigid_plastic = false;
    double sagging = 0, hogging = 0;  ///< yield moments [N m]
    /// Stiffness of the member end in double curvature, before and after yield at both ends [N m/rad].
    double end_stiffness = 0, end_tangent = 0;
    std::optional<double> ultimate_rotation{};  ///< plastic rotation capacity [rad]
  };
  /// A parameter of the law, for reports.
  struct Parameter {
    std::string name;  ///< the input key: "yield_force"
    double value;
  };

  std::string name;  ///< "storey 1", "beam 0.1 start"
  /// Deformation of the law as factors of the unknowns [m] or [rad], which may be massless.
  Row deformation;
  double at_rest = 0;  ///< deformation under gravity, to be added
  std::string law;     ///< the input keyword: "bilinear"
  std::vector<Parameter> parameters;
  std::shared_ptr<const Element> element;  ///< shared by successive parts, one per deformation
  int direction = 0;                       ///< index of the deformation of the element
  YieldLimits limits;                      ///< deformations at first yield
  Kind kind = Kind::storey;
  std::optional<Hinge> hinge{};  ///< of a hinge
  std::string device{};          ///< of a device: its components and ends, for reports

  bool is_device() const noexcept { return kind == Kind::device; }  ///< true for a device
  /// Value of a parameter; NaN if there is none of this name.
  double parameter(std::string_view parameter_name) const;

  /// True for an element with a single deformation; and that element.
  bool has_spring() const noexcept { return element->deformations() == 1; }
  const Spring& spring() const noexcept { return static_cast<const Spring&>(*element); }
  /// Stiffness in K and deformation at first yield, see Element.
  double stiffness() const noexcept { return element->stiffness(direction); }
  double yield_deformation() const noexcept { return element->yield_deformation(direction); }
  /// Initial slope that K does not contain [N/m].
  double first_slope() const noexcept { return has_spring() ? spring().first_slope() : 0; }

  YieldingPart(std::string part, Row factors, std::string law_name, std::vector<Parameter> numbers,
               std::shared_ptr<const Element> by_element, int of_direction = 0);
};

/// A time-dependent force on a structure.
struct AppliedForce {
  std::string place;     ///< "floor 3 ux", for reports
  Row direction;         ///< displacement that the force does work on
  GroundMotion history;  ///< [N], or [N m] for a moment
};

/// Supports with a common ground motion.
struct Support {
  std::string name;                                    ///< for messages; empty if the structure has one support only
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position at which a travelling wave arrives [m]
  double delay = 0;                                    ///< delay of the ground motion [s]
  std::optional<GroundComponents> motion;              ///< separate motion, instead of that of the model
  /// n x 3: displacements of the unknowns for a unit displacement of the ground here along x, y, z, with the other
  /// supports at rest.
  Eigen::MatrixX3d influence;
  Eigen::MatrixX3d load;  ///< n x 3 [kg]: mass times influence, and the mass coupling of the unknowns to the support

  // Response to such a motion with the unknowns at rest; empty in a structure with one support, to which all is
  // relative.
  Eigen::MatrixX3d enforced;  ///< displacements of the nodes, see ContactPoint::supported
  Eigen::MatrixX3d nodes;     ///< rows of NodeReport, node by node
  Eigen::MatrixX3d shears;    ///< storey shears, floor by floor [N/m]
  Eigen::MatrixX3d forces;    ///< InternalForces, row by row [N/m], [N]
};

/// One floor.
struct Floor {
  std::string label;                ///< "1" for the lowest
  double mass = 0;                  ///< mass moving along x with the floor [kg]
  std::optional<double> elevation;  ///< above the common datum [m]; `nullopt` if heights were not given
  double beam_depth = 0;            ///< of its deepest beam [m]; 0 without beams
  /// Reported displacements: x; in space also y and the rotation about z.
  std::vector<Row> motion;
  /// Extent of a rigid floor in space, relative to the point whose motion is reported: minimum x, maximum x, minimum
  /// y, maximum y [m]. nullopt for other floors.
  std::optional<std::array<double, 4>> plan{};
  /// Shear forces of the storey below, along x, and y in space [N]; empty in a structure without storeys.
  std::vector<Row> storey_shear;
  /// Direct contribution of yielding parts to each of them, as factors of their forces; empty if there is none.
  std::vector<Row> storey_shear_by_yielding;
};

/// A possible contact point of a structure.
struct ContactPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  std::array<Row, 3> motion;                           ///< displacements along x, y, z
  /// Displacements due to the enforced motion of supports (Support::enforced), for a point on a member that ends at
  /// one. Otherwise empty.
  std::array<Row, 3> supported;
  double mass = 0;  ///< mass for the calibration of link damping: of the floor or of the node [kg]
  int member = -1;  ///< member that is hit between its ends
  /// End forces of the member due to a unit force along x, y, z at the point, local axes, with fixed nodes.
  Eigen::Matrix<double, 12, 3> fixed_ends = Eigen::Matrix<double, 12, 3>::Zero();
  /// Reactions to the share of such a force that goes directly into a support at the end of the member, in the order of
  /// InternalForces. Empty if there is none.
  Eigen::MatrixX3d reactions;
  /// Distance of a point on a column to the nearer joint, and depth of the column along the contact [m].
  double to_joint = std::numeric_limits<double>::infinity(), column_depth = 0;
};

/// Horizontal direction, along or against x or y, that a side faces.
enum class Side { plus_x, minus_x, plus_y, minus_y };
Eigen::Vector3d outward(Side side);
Side opposite(Side side);
/// Side that faces a horizontal direction of contact.
Side side_of(const Eigen::Vector3d& direction);

/// Outer surface of the columns in line with a point.
struct ColumnFace {
  double distance = 0;  ///< outwards from the point [m]
  std::string column;   ///< name of the column with the outermost surface
  bool is_estimated =
      false;  ///< true if the section is given by its properties: the depth is that of an equivalent rectangle
};

/// Outward distance from the axes of a structure to the face of contact.
struct Face {
  double distance = 0;      ///< [m]
  bool by_columns = false;  ///< that of the columns, see Surface::column_face, instead of the distance
};

/// Possible contact points of a structure. Implemented by each kind of structure; floors are numbered from 0 at the
/// lowest. Throws std::invalid_argument, listing what exists, for a floor, column or node that does not exist.
class Surface {
 public:
  virtual ~Surface() = default;
  /// Extent in plan [m]: {minimum x, maximum x, minimum y, maximum y}; `nullopt` for a structure without a position.
  virtual std::optional<std::array<double, 4>> plan() const { return {}; }
  /// Ends of the edge of a floor on this side, measured along it (y for sides that face x); equal if it has no width.
  virtual std::array<double, 2> edge(int /*floor*/, Side /*side*/) const { return {0, 0}; }
  /// Point of a floor on this side at the coordinate `along` of its edge.
  virtual ContactPoint floor(int floor, Side side, double along) const = 0;
  /// Point of the column on this side at this elevation [m]; in space, of the column nearest to `along`.
  virtual ContactPoint column(double elevation, Side side, double along) const;
  virtual ContactPoint node(const std::string& name) const;
  /// Outermost surface on this side of all columns in line with a point: facades are flat, whatever the column depths
  /// of individual storeys. `nullopt` if no column is in line.
  virtual std::optional<ColumnFace> column_face(const Eigen::Vector3d& /*point*/, Side /*side*/) const { return {}; }
  /// Displacement of a node by name, "ux" ... "rz".
  virtual Row displacement(const std::string& node, const std::string& dof) const;
};

/// Nodes with reported motion, in the order of `directions` ("x", "z", "ry" ...).
struct NodeReport {
  std::vector<std::string> names, directions;
  std::vector<std::vector<Row>> motion;  ///< of each node in each direction
};

/// Reported forces from displacements, and from the forces in members with a memory, which may be empty.
using NonlinearReport =
    std::function<Eigen::VectorXd(const Eigen::VectorXd& displacement, const Eigen::VectorXd& in_members)>;

/// End forces of all members, in their local axes, and reactions of the ground at supported nodes, in global axes: the
/// forces that it exerts on the structure, without damping forces.
struct InternalForces {
  std::vector<std::string> members, components;  ///< "start N", "start Vz", "start My", "end N" ...
  std::vector<int> places;                       ///< index of each component among the twelve of a member
  bool with_gravity = false;                     ///< true if the weights of the masses are included
  std::string included;  ///< included loads and geometric effects, for reports: "gravity, P-Delta"
  std::vector<std::string> supports, directions;  ///< names of the nodes; "x", "z", "ry" ...
  /// As factors of the unknowns: member by member and component by component, then node by node and direction by
  /// direction.
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows;
  Eigen::VectorXd at_rest;  ///< contribution of loads with the unknowns at rest, per row [N], [N m]
  /// [row, part]: direct contribution of yielding parts, as factors of their forces; empty if there is none.
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_yielding;
  /// Forces of members that are nonlinear in the displacements, to be added to the two above: a function of q + at_rest
  /// of the structure, and of the forces in members with a memory (TangentForces::member_forces). Empty if there are
  /// none.
  NonlinearReport nonlinear;
};

/// A section of fibres, for reports and plausibility warnings.
struct FibreSectionReport {
  /// One of its materials.
  struct Law {
    std::string name, law;                               ///< of the input
    double modulus = 0;                                  ///< initial [Pa]
    double code_modulus = 0;                             ///< of concrete of this strength [Pa]; 0 for other materials
    bool forgets_small_reversals = true;                 ///< false if no error tolerance applies
    std::vector<YieldingPart::Parameter> confinement{};  ///< computed values of confined concrete
  };
  /// Beams whose ends rigid floors keep at a distance: moments at a curvature with and without this restraint.
  struct Restraint {
    int beams = 0;
    double curvature = 0, moment = 0, free_moment = 0, axial_force = 0;  ///< [1/m], [N m], [N]
  };

  std::string name;
  std::vector<Law> laws;
  double area = 0, bending_stiffness = 0;  ///< gross [m^2]; uncracked EI about y [N m^2]
  int members = 0, yielding = 0;           ///< number of members with it, and of those that yield along their length
  std::optional<Restraint> restraint{};
};

/// For pictures and plausibility warnings.
struct Geometry {
  std::vector<std::string> node_names, member_names;
  std::vector<Eigen::Vector3d> positions;   ///< of the nodes [m]
  std::vector<std::array<int, 2>> members;  ///< nodes of each
  std::vector<double> depths, moduli;  ///< of each: the larger depth of a square and of a rectangle with its area and
                                       ///< inertia [m]; Young's modulus [Pa]
  std::vector<int> floor_of_node;      ///< -1 for none
};

/// The unknowns q are displacements relative to the ground and to the equilibrium under gravity. With several supports
/// that move differently, they are relative to the quasi-static response, influence times the displacements of the
/// supports. A wall has no unknowns.
struct Structure {
  Structure() = default;
  Structure(Structure&&) = default;  // not noexcept: Eigen 3.4 copies sparse matrices, which may throw std::bad_alloc
  Structure& operator=(Structure&&) = default;

  std::string name;
  std::string kind;                              ///< the input keyword: oscillator, shear_building, frame ...
  int dimension = 1;                             ///< 1: along x only; 2: in x and z; 3: in space
  SparseMatrix mass, stiffness;                  ///< n x n, symmetric [kg], [N/m]
  SparseMatrix damping;                          ///< n x n, in addition to Rayleigh and modal damping [N s/m]
  std::shared_ptr<const ElasticForces> elastic;  ///< nonlinear elastic forces that replace K q; null if linear
  std::shared_ptr<const TangentForces> tangent;  ///< forces with a memory that replace K q; null if there are none
  double by_mass = 0, by_stiffness = 0;          ///< Rayleigh damping: by_mass M + by_stiffness K [1/s], [s]
  double modal_ratio = 0;             ///< modal damping: fraction of critical damping in every mode of M and K [-]
  SparseMatrix modal_damping;         ///< its matrix, which is dense [N s/m]; empty until needed
  std::vector<std::string> unknowns;  ///< description of each unknown, for messages
  /// Supports in the order in which a wave along a horizontal direction arrives; empty if all are at one position.
  std::function<std::vector<Support>(const Eigen::Vector3d& direction)> supports_along;
  std::vector<Support> supports;         ///< at least one; displacements are relative to the ground at the first
  std::vector<Floor> floors;             ///< from the ground up
  std::vector<double> storey_stiffness;  ///< of a structure whose storeys are springs, from the ground up [N/m]
  /// Storeys that are springs, from the ground up, or hinges followed by isolators of a frame; then devices. Empty if
  /// the structure is elastic.
  std::vector<YieldingPart> yielding;
  /// [part, part], symmetric: instantaneous decrease of the deformations of yielding parts per unit of their forces,
  /// [m/N] or [rad/(N m)], in addition to the compliance of massless degrees of freedom. Used for a hinge in series
  /// with a member. Empty if there is none.
  SparseMatrix yielding_flexibility;
  bool is_free = false;      ///< true without a connection to the ground: a body
  std::optional<Face> face;  ///< contact face for links; nullopt: the axes of the structure
  int rigid_motions = 0;     ///< of a frame without supports: its number of rigid-body modes of frequency 0, 3 or 6
  std::vector<AppliedForce> applied_forces;                ///< time-dependent
  Eigen::VectorXd at_rest;                                 ///< displacements under gravity [m]; empty if there are none
  Eigen::VectorXd initial_displacement, initial_velocity;  ///< of the unknowns [m], [m/s]
  Eigen::VectorXd preload_displacement;  ///< of contacts that are preloaded at the start, added to the initial one [m];
                                         ///< empty if none
  /// Lowest frequencies, at least two if available, increasing [rad/s]; without rigid-body modes; 0 for a body.
  Eigen::VectorXd frequencies;
  std::string damping_note;  ///< description of the damping, one line
  std::shared_ptr<const Surface> surface;
  NodeReport nodes;
  InternalForces forces;              ///< of a frame
  std::vector<int> reported_members;  ///< indices of the members with recorded end forces
  /// Storey shears of such members, floor by floor, to be added to those of the floors; as InternalForces::nonlinear.
  NonlinearReport storey_shears;
  Geometry geometry;
  std::vector<FibreSectionReport> fibre_sections;  ///< of a frame, in the order of its members
  /// Translations of all nodes of the geometry, nodes x 3; empty without geometry.
  std::function<Eigen::MatrixX3d(const Eigen::VectorXd& q)> node_translations;

  /// Number of unknowns.
  int size() const { return static_cast<int>(mass.rows()); }
  /// True for a wall, which moves with the ground.
  bool is_rigid() const { return size() == 0; }
  /// Why K is not its stiffness away from the state at rest: "its members have large rotations (corotational)"; empty
  /// if it is, apart from yielding parts.
  std::string why_stiffness_changes() const {
    if (tangent) return "its members are of fibres";
    return elastic ? "its members have large rotations (corotational)" : "";
  }
  /// Number of parts other than devices, which come first. For a shear building: its isolators, all storeys above them,
  /// or both, from the ground up.
  std::size_t members_that_yield() const;
  /// True if drift and storey shear are defined.
  bool has_storeys() const { return !floors.empty() && !floors.front().storey_shear.empty(); }
  /// Damping matrix, without modal damping if its matrix has not been formed.
  SparseMatrix formed_damping() const;
  /// Complete damping matrix. Forms that of modal damping if necessary; throws std::invalid_argument like
  /// modal_damping_matrix().
  SparseMatrix whole_damping() const;
  /// Mass excited by ground motion along x, y, z, for all supports together [kg].
  Eigen::Vector3d total_mass() const;
};

}  // namespace pounding
