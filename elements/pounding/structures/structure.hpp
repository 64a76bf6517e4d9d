#pragma once
/// One structure: its matrices, its floors, where others can touch it, what is reported of it.

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

#include <pounding/core/archive.hpp>
#include <pounding/ground/components.hpp>
#include <pounding/structures/elastic_forces.hpp>
#include <pounding/structures/massless.hpp>
#include <pounding/structures/spring.hpp>
#include <pounding/structures/yield_limits.hpp>

namespace pounding {

/// How the unknowns of a structure make one quantity: their factors.
using Row = Eigen::SparseVector<double>;

/// A part of a structure that yields, in parallel to the stiffness that K has for it: a storey, a hinge at the end of a
/// member. Or a device between two of its points, which K has nothing of.
struct YieldingPart {
  /// A device adds to the stiffness, the others are in it.
  enum class Kind { storey, hinge, isolator, device };
  /// A number that its law was made with, for reports.
  struct Parameter {
    std::string name;  ///< the word of the input: "yield_force"
    double value;
  };

  std::string name;  ///< "storey 1", "beam 0.1 start"
  /// The deformation that its law follows, as factors of the unknowns [m] or [rad]. Unknowns without mass may be among
  /// them.
  Row deformation;
  double at_rest = 0;  ///< deformation under gravity, to be added
  std::string law;     ///< the word of the input: "bilinear"
  std::vector<Parameter> parameters;
  std::unique_ptr<Spring> spring;
  YieldLimits limits;            ///< deformations at which it first yields
  std::vector<std::byte> fresh;  ///< archive of the spring as it was given
  Kind kind = Kind::storey;
  std::string device{};  ///< of a device: its parts and its ends, for reports

  bool is_device() const noexcept { return kind == Kind::device; }  ///< whether it is one
  /// The number of a parameter; NaN for one that it does not have.
  double parameter(std::string_view parameter_name) const;

  /// Takes a spring that has not been deformed.
  YieldingPart(std::string part, Row factors, std::string law_name, std::vector<Parameter> numbers,
               std::unique_ptr<Spring> undeformed);
};

/// A force that acts on a structure over time.
struct AppliedForce {
  std::string place;     ///< "floor 3 ux", for reports
  Row direction;         ///< the displacement on which it works
  GroundMotion history;  ///< [N], or [N m] for a moment
};

/// Supports that the ground moves alike.
struct Support {
  std::string name;                                    ///< for messages; empty where the structure has one support only
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< where a travelling wave arrives [m]
  double delay = 0;                                    ///< the ground moves later here [s]
  std::optional<GroundComponents> motion;              ///< of its own instead of the model's
  /// n x 3: where the unknowns go when the ground moves by one here along x, y, z and rests at the other supports.
  Eigen::MatrixX3d influence;
  Eigen::MatrixX3d load;  ///< n x 3 [kg]: mass times influence, and what couples the unknowns to the support

  // Response to such a motion while the unknowns rest; empty in a structure with one support, which all is relative to.
  Eigen::MatrixX3d enforced;  ///< displacements of the nodes, see ContactPoint::supported
  Eigen::MatrixX3d nodes;     ///< rows of NodeReport, node by node
  Eigen::MatrixX3d shears;    ///< storey shears, floor by floor [N/m]
  Eigen::MatrixX3d forces;    ///< InternalForces, row by row [N/m], [N]
};

/// One floor.
struct Floor {
  std::string label;                ///< "1" at the lowest
  double mass = 0;                  ///< that moves along x with it [kg]
  std::optional<double> elevation;  ///< above the common datum [m]; nothing where heights were not given
  double beam_depth = 0;            ///< of its deepest beam [m]; 0 for a floor without beams
  /// Displacements that are reported: x; and y and the turn about z in a structure in space.
  std::vector<Row> motion;
  /// Extent of a rigid floor in space, relative to the point whose motion is reported: smallest x, largest x, smallest
  /// y, largest y [m]. nullopt for other floors.
  std::optional<std::array<double, 4>> plan{};
  /// Shear forces of the storey below, along x, and y in space [N]; empty in a structure without storeys.
  std::vector<Row> storey_shear;
  /// The part of each of them that yielding parts add directly, as factors of their forces; empty for none.
  std::vector<Row> storey_shear_by_yielding;
};

/// A point where a structure can be touched.
struct ContactPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  std::array<Row, 3> motion;                           ///< displacements along x, y, z
  /// Displacements by what supports enforce (Support::enforced), of a point on a member that ends at one. Else empty.
  std::array<Row, 3> supported;
  double mass = 0;  ///< that the damping of a link is calibrated with: of the floor or of the node [kg]
  int member = -1;  ///< that is met between its ends
  /// Forces on the ends of the member by a unit force along x, y, z at the point, local axes, its nodes held.
  Eigen::Matrix<double, 12, 3> fixed_ends = Eigen::Matrix<double, 12, 3>::Zero();
  /// Reactions to such a force, which goes straight into a support that holds an end: in the order of InternalForces.
  /// Empty for none.
  Eigen::MatrixX3d reactions;
  /// Distance of a point on a column to the nearer joint, and size of the column along the contact [m].
  double to_joint = std::numeric_limits<double>::infinity(), column_depth = 0;
};

/// Horizontal direction, along or against x or y, in which a side faces.
enum class Side { plus_x, minus_x, plus_y, minus_y };
Eigen::Vector3d outward(Side side);
Side opposite(Side side);
/// The side that faces along a horizontal direction of contact.
Side side_of(const Eigen::Vector3d& direction);

/// Outer surface of the columns in line with a point.
struct ColumnFace {
  double distance = 0;        ///< from the point outwards [m]
  std::string column;         ///< name of the member whose surface is outermost
  bool is_estimated = false;  ///< whether its section is given by numbers: the size is that of a rectangle with them
};

/// Distance from the axes by which a structure is drawn outwards to the face at which it is hit.
struct Face {
  double distance = 0;      ///< [m]
  bool by_columns = false;  ///< that of the columns, see Surface::column_face, instead of the distance
};

/// Points at which a structure can be touched. Made by the kind of structure; floors count from 0 at the lowest. What
/// is asked for and does not exist throws std::invalid_argument with what there is.
class Surface {
 public:
  virtual ~Surface() = default;
  /// In plan [m]: {least x, largest x, least y, largest y}; nothing for a structure that has no place of its own.
  virtual std::optional<std::array<double, 4>> plan() const { return {}; }
  /// Ends of the edge of a floor on this side, measured along it (y for sides that face x); a point where there is no
  /// width.
  virtual std::array<double, 2> edge(int /*floor*/, Side /*side*/) const { return {0, 0}; }
  /// The point of a floor on this side at `along` on the edge.
  virtual ContactPoint floor(int floor, Side side, double along) const = 0;
  /// The point of the column on this side at this elevation [m]; in space of the column nearest to `along`.
  virtual ContactPoint column(double elevation, Side side, double along) const;
  virtual ContactPoint node(const std::string& name) const;
  /// Outermost surface on this side of all columns in line with a point: a facade is flat, whatever the columns of
  /// single storeys measure. Nullopt if no column is in line.
  virtual std::optional<ColumnFace> column_face(const Eigen::Vector3d& /*point*/, Side /*side*/) const { return {}; }
  /// The displacement of a node by its name, "ux" ... "rz".
  virtual Row displacement(const std::string& node, const std::string& dof) const;
};

/// Nodes whose motion is reported, in the order of `directions` ("x", "z", "ry" ...).
struct NodeReport {
  std::vector<std::string> names, directions;
  std::vector<std::vector<Row>> motion;  ///< of each node in each direction
};

/// End forces of all members, in their local axes, and reactions of the ground at the nodes that it holds, in global
/// axes: what it exerts on the structure, without the forces of damping.
struct InternalForces {
  std::vector<std::string> members, components;  ///< "start N", "start Vz", "start My", "end N" ...
  std::vector<int> places;                       ///< of each component among the twelve of a member
  bool with_gravity = false;                     ///< the weights of the masses are included
  std::string included;  ///< loads and geometry that are included, for reports: "gravity, P-Delta"
  std::vector<std::string> supports, directions;  ///< names of the nodes; "x", "z", "ry" ...
  /// As factors of the unknowns: member by member and component by component, then node by node and direction by
  /// direction.
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows;
  Eigen::VectorXd at_rest;  ///< what loads add while the unknowns rest, one a row [N], [N m]
  /// [row, part]: the part that yielding parts add directly, as factors of their forces; empty for none.
  Eigen::SparseMatrix<double, Eigen::RowMajor> by_yielding;
  /// Forces of members that turn, to be added to the two above, by q + at_rest of the structure; empty for none.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& displacement)> turned;
};

/// For pictures, and for warnings of the implausible.
struct Geometry {
  std::vector<std::string> node_names, member_names;
  std::vector<Eigen::Vector3d> positions;   ///< of the nodes [m]
  std::vector<std::array<int, 2>> members;  ///< nodes of each
  std::vector<double> depths, moduli;  ///< of each: the larger of those of a square and of a rectangle of its area and
                                       ///< inertia [m]; Young's modulus [Pa]
  std::vector<int> floor_of_node;      ///< -1 for none
};

/// The unknowns q are displacements relative to the ground, and to where the structure rests under gravity. With
/// several supports that move differently they are relative to where the ground takes the structure statically,
/// influence times the displacements of the supports. A wall has no unknown at all.
struct Structure {
  Structure() = default;
  Structure(Structure&&) = default;  // not noexcept: Eigen 3.4 copies sparse matrices, for which memory may be lacking
  Structure& operator=(Structure&&) = default;

  std::string name;
  std::string kind;                              ///< the word of the input: oscillator, shear_building, frame ...
  int dimension = 1;                             ///< 1: along x only; 2: in x and z; 3: in space
  SparseMatrix mass, stiffness;                  ///< n x n, symmetric [kg], [N/m]
  SparseMatrix damping;                          ///< n x n, beside the Rayleigh and the modal damping [N s/m]
  std::shared_ptr<const ElasticForces> elastic;  ///< where they are not K q; nothing else
  double by_mass = 0, by_stiffness = 0;          ///< Rayleigh damping: by_mass M + by_stiffness K [1/s], [s]
  double modal_ratio = 0;             ///< modal damping: part of critical damping in every mode of M and K [-]
  SparseMatrix modal_damping;         ///< its matrix, which is full [N s/m]; empty where nothing has needed it
  std::vector<std::string> unknowns;  ///< what each unknown is, for messages
  /// The supports as a wave along a horizontal direction reaches them one after the other; empty where they are at one
  /// place.
  std::function<std::vector<Support>(const Eigen::Vector3d& direction)> supports_along;
  std::vector<Support> supports;         ///< one at least; displacements are relative to the ground at the first
  std::vector<Floor> floors;             ///< from the ground up
  std::vector<double> storey_stiffness;  ///< of a structure whose storeys are springs, from the ground up [N/m]
  /// Storeys that are springs, from the ground up, or hinges, then isolators of a frame; then devices. Empty when all
  /// stays elastic.
  std::vector<YieldingPart> yielding;
  /// [part, part], symmetric: by how much the forces of the yielding parts shorten their deformations at once, on top
  /// of the unknowns without mass that give way to them, [m/N] or [rad/(N m)]. A hinge in series with a member gives
  /// way like this. Empty for none.
  SparseMatrix yielding_flexibility;
  bool is_free = false;      ///< nothing holds it to the ground: a body
  std::optional<Face> face;  ///< at which links meet it; nullopt: the axes by which it is drawn
  int rigid_motions = 0;     ///< of a frame that nothing holds, which has this many modes of frequency 0: 3 or 6
  std::vector<AppliedForce> applied_forces;                ///< over time
  Eigen::VectorXd at_rest;                                 ///< displacements under gravity [m]; empty for none
  Eigen::VectorXd initial_displacement, initial_velocity;  ///< of the unknowns [m], [m/s]
  Eigen::VectorXd
      preload_displacement;  ///< by contacts that press from the start, added to the initial one [m]; empty for none
  /// Of its lowest modes, at least two where it has them, increasing [rad/s]; without rigid motions; 0 for a body.
  Eigen::VectorXd frequencies;
  std::string damping_note;  ///< how the damping was made, one line
  std::shared_ptr<const Surface> surface;
  NodeReport nodes;
  InternalForces forces;              ///< of a frame
  std::vector<int> reported_members;  ///< numbers of the members whose end forces are kept over time
  /// Storey shears of members that turn, floor by floor, to be added to those of the floors; by q + at_rest. Empty for
  /// none.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& displacement)> storey_shears;
  Geometry geometry;
  /// Translations of all nodes of the geometry, nodes x 3; empty without geometry.
  std::function<Eigen::MatrixX3d(const Eigen::VectorXd& q)> node_translations;

  /// Number of unknowns.
  int size() const { return static_cast<int>(mass.rows()); }
  /// A wall: it moves with the ground.
  bool is_rigid() const { return size() == 0; }
  /// Number of parts that are no devices, which come first. Of a shear building its isolators, all storeys above them,
  /// or both, from the ground up.
  std::size_t members_that_yield() const;
  /// Whether drift and storey shear mean something.
  bool has_storeys() const { return !floors.empty() && !floors.front().storey_shear.empty(); }
  /// The damping matrix, without modal damping whose matrix has not been formed.
  SparseMatrix formed_damping() const;
  /// The whole damping matrix. Forms that of modal damping where it has not been; throws std::invalid_argument as
  /// modal_damping_matrix().
  SparseMatrix whole_damping() const;
  /// The mass that the ground moves along x, y, z, by all supports together [kg].
  Eigen::Vector3d total_mass() const;
};

}  // namespace pounding
