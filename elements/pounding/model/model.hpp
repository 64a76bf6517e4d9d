#pragma once
/// A model: structures, the links between them, the ground motion. Built by code or read from an input
/// (input/read_model.hpp). SI units.

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/ground/components.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/model/contact_stiffness.hpp>
#include <pounding/model/forces.hpp>
#include <pounding/model/model_error.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/model/scheme.hpp>
#include <pounding/structures/device_spring.hpp>
#include <pounding/structures/one_or_each.hpp>
#include <pounding/structures/structure.hpp>
#include <pounding/structures/structure_damping.hpp>

namespace pounding {

class ContactLaw;
struct System;

/// One side of a link.
struct LinkEnd {
  int structure = 0;  ///< from 0
  int floor = -1;     ///< from 0; -1 for a wall, a node, and a point between floors
  std::string label;  ///< "floor 3", "node b", "10.5 m up"; empty for a wall
  ContactPoint point;
  std::optional<double>
      face{};  ///< distance from the point outwards to the contact face [m]; nullopt: not given, the two coincide
  std::string face_column{};  ///< column with this surface; empty if the distance was given
};

/// One contact between two points that face each other.
struct Link {
  std::string name;
  LinkEnd left, right;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< from left to right
  double gap = 0;                                        ///< [m]
  bool preload = false;                                  ///< closed at the start
  std::optional<double> seat{};                          ///< see LinkOptions::seat [m]
  std::string law, formula;
  double reduced_mass = 0;  ///< used to calibrate the damping [kg]
  bool reduced_mass_given = false;
  std::string stiffness_from;                   ///< method by which the stiffness was estimated; empty if it was given
  std::vector<laws::ResolvedValue> parameters;  ///< of the law, calibrated damping included
  double friction = 0;                          ///< Coulomb's coefficient
  double sliding_velocity = 0;                  ///< regularisation velocity, see Friction [m/s]
  double static_friction = 0;                   ///< coefficient at rest; 0: like `friction`
  double stribeck_velocity = 0;                 ///< [m/s]
  double tangential_stiffness = 0;              ///< constant [N/m]; 0: none
  double tangential_ratio = 0;                  ///< of the tangential stiffness to the slope of the law; 0: none
  double pressed = 0;                           ///< penetration at the start of a preloaded contact [m]
  std::shared_ptr<const Contact> contact;

  /// True if one of its ends is on this structure, counted from 0.
  bool hits(int structure) const { return left.structure == structure || right.structure == structure; }
};

/// A bar or a hysteretic law, a damper, or both in parallel between two structures: it always acts, in both directions.
/// Gravity and preloads leave it undeformed.
struct Device {
  std::string name;
  LinkEnd left, right;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< line of action, from left to right
  std::optional<double> length;                          ///< in the drawing [m]
  DeviceParts parts;
  std::shared_ptr<const DeviceSpring> member;
};

/// Below the minimum, round-off exceeds the error; above the maximum, impacts are not resolved.
inline constexpr double min_tolerance = 1e-10, max_tolerance = 0.1;

/// Default and maximum number of steps of a run; PETSc counts steps in 32 bits.
inline constexpr long default_max_steps = 100'000'000, max_step_count = 2'000'000'000;

/// Time integration of a model. PETSc options may change tolerance and scheme.
struct AnalysisSettings {
  double duration = 0;      ///< of the run, which starts at time 0 [s]; 0: until the ground motion ends
  double tolerance = 1e-4;  ///< relative error of motion and link forces [-], in [min_tolerance, max_tolerance]
  double output_step = 0;  ///< spacing of the output times from 0 [s]; 0: minimum sample spacing of the ground motions,
                           ///< or a thousandth of the duration without samples
  Scheme scheme{};         ///< time integration scheme
  double max_step =
      0;  ///< maximum step [s]; 0: sample spacing of the record, otherwise from the shortest period of the model
  /// Maximum number of steps, in [1, max_step_count]; the run then ends and can be resumed.
  long max_steps = default_max_steps;
  Reduction reduction{};                          ///< default for all structures
  std::map<std::string, Reduction> reductions{};  ///< of single structures, by name
  double collapse_drift = 0;  ///< storey drift ratio at which the run ends as completed [-]; 0: none
};

/// Maximum interval between checkpoints; each one also updates the results file. Zero: not requested.
struct CheckpointSettings {
  double every = 0;            ///< of run time [s]
  double every_simulated = 0;  ///< of simulated time [s]

  /// True if checkpoints are requested.
  bool requested() const { return every > 0 || every_simulated > 0; }
};

/// Contact point on a structure, to be located on its surface. Created by a StructureHandle.
struct ContactLocation {
  int structure = 0;                  ///< from 0
  std::optional<int> floor{};         ///< from 1 at the lowest
  std::optional<double> elevation{};  ///< of a point of a column [m]
  std::string node{};
  std::optional<Face> face{};  ///< instead of that of the structure
};

/// A structure of a model. Without floor or node, it denotes a wall or the single floor of a structure.
class StructureHandle {
 public:
  explicit StructureHandle(int number) : number_(number) {}
  /// Index in Model::structures.
  int number() const noexcept { return number_; }
  /// A floor, from 1 at the lowest.
  ContactLocation floor(int number) const { return {.structure = number_, .floor = number}; }
  /// A node of a frame.
  ContactLocation node(std::string name) const { return {.structure = number_, .node = std::move(name)}; }
  /// The column of a frame at an elevation above the common datum [m].
  ContactLocation at(double elevation) const { return {.structure = number_, .elevation = elevation}; }
  operator ContactLocation() const { return {.structure = number_}; }

 private:
  int number_;
};

/// Initial displacement of a node of a frame.
struct NodeDisplacement {
  std::string node;
  std::string dof = "ux";  ///< ux ... rz
  double value = 0;        ///< [m], [rad]
};

/// Options of a structure of any kind.
struct StructureOptions {
  /// Required for all structures except bodies and walls, unless the structure was created with its damping; 0 for
  /// none.
  std::optional<Damping> damping{};
  /// Along x [m/s]: of the floors, one for all or one per floor from the ground up; of a frame as a whole.
  OneOrEach initial_velocity{};
  /// Along x [m]: of the floors, one for all or one per floor from the ground up. All other displacements of a frame
  /// are the static response to forces that hold the floors there.
  OneOrEach initial_displacement{};
  std::vector<NodeDisplacement>
      initial_node_displacements{};    ///< alternative for frames; all other displacements follow in the same way
  std::vector<ForceOptions> forces{};  ///< forces over time
  double delay = 0;                    ///< delay of the ground motion here [s]
  std::optional<GroundComponents> ground_motion{};  ///< instead of the one of the model
  std::optional<Face> face{};                       ///< of a frame drawn at its axes: distance to the contact faces
};

/// Floors of two structures that a link joins, instead of one pair.
enum class FacingFloors {
  all,    ///< all floors up to the lower roof; each must face a floor of the other structure
  level,  ///< floors level with a floor of the other structure
  any     ///< all floors up to the lower roof; those that face no floor hit the column there
};

/// Floors whose elevations differ by less are level, whatever the depth of their beams [m].
inline constexpr double usual_level = 0.05;

/// Options of a link, except its law.
struct LinkOptions {
  /// >= 0, or < 0 with a preload [m]; with `floors` one for all or one per floor from the ground up. Optional between
  /// frames: it is the distance between their faces in the drawing. A different value is rejected unless it is a
  /// preload.
  OneOrEach gap{};
  /// The two ends are closed at the start if the gap is negative: undeformed they would overlap, and the run starts in
  /// static equilibrium with the structures pushed apart.
  bool preload = false;
  std::optional<FacingFloors> floors{};  ///< links all of these; if empty, the two ends are one pair
  /// Maximum difference in elevation of two level floors [m]; default: depth of the deeper beam, at least usual_level.
  std::optional<double> level_within{};
  /// Default: "left.1-right.1"; of several pairs the first is "name.1".
  std::optional<std::string> name{};
  /// Contact points along the common edge of floors in space, 1 to 100; default: two if the edges overlap, otherwise
  /// one.
  std::optional<int> points{};
  std::optional<double> friction{};          ///< Coulomb coefficient >= 0; only for frames and for laws with a force
  std::optional<double> sliding_velocity{};  ///< regularisation velocity of the friction [m/s]; default: 5 mm/s
  /// Length of the seat that supports one end on the other [m]: the run warns if the joint opens by more, from its
  /// width in the undeformed state. It has no effect on forces.
  std::optional<double> seat{};
  /// Coefficient at rest, at least `friction`; requires a tangential stiffness and the velocity of its decay [m/s].
  std::optional<double> static_friction{}, stribeck_velocity{};
  /// Stiffness along the contact until it slips: constant [N/m], or as a ratio to the slope of the law.
  std::optional<double> tangential_stiffness{}, tangential_ratio{};
  /// Mass for calibrating the damping [kg]; default: that of the law, otherwise that of the masses at the two ends.
  std::optional<double> reduced_mass{};
  /// Estimates the stiffness of the law from the masses at the two ends, instead of the stiffness in the law.
  std::optional<StiffnessEstimate> stiffness{};
};

/// Bar by its section: the stiffness is E A divided by the length in the drawing.
struct BarSection {
  double young = 0;  ///< E [Pa]
  double area = 0;   ///< A [m^2]
};

/// Parts of a device; at least one, and not both a bar and a law.
struct DeviceOptions {
  std::optional<std::variant<Bar, BarSection>> bar{};
  std::optional<hysteresis::Settings> law{};  ///< hysteretic law by name, including its stiffness
  std::optional<Damper> damper{};
};

/// Direction of a device within one structure.
enum class DeviceAxis { along, x, y, z };

/// End of a device within one structure: a node, a floor, or the ground.
struct DeviceEnd {
  std::string node{};
  std::optional<int> floor{};  ///< from 1 at the lowest
};

/// A valid but implausible value of a model.
struct Warning {
  std::string name;  ///< for Model::accept, to suppress it
  std::string text;  ///< location, number and probable cause
};

/// Model::source_text of a model that was not read from a text.
inline constexpr std::string_view built_by_code =
    "# This model was built by a program, not read from a file; see resolved.yaml for its contents.\n";

/// Everything that is simulated. Structures are added first, then links and devices between them; ground motion,
/// analysis settings and all other members may be set at any time before the model is completed.
class Model {
 public:
  std::string title;
  std::string project;  ///< name of the project, for reports
  GroundSection ground;
  AnalysisSettings analysis;
  CheckpointSettings checkpoint;
  bool compare_no_pounding = false;  ///< true to run the structures without links first
  /// Multiplies the stiffness of all contacts linked from now on, to study the sensitivity of the response.
  double stiffness_factor = 1;
  std::vector<std::string> accept;     ///< plausibility warnings to suppress, see warning_names.hpp
  std::vector<Warning> read_warnings;  ///< of the reader, about the notation of numbers
  /// Computes the modes for damping and first periods. petsc::lowest_modes does so for frames of many thousand
  /// unknowns.
  ModeSolver mode_solver = dense_modes;
  std::string source_text{built_by_code};  ///< the input as given
  std::string source_file;  ///< path as given by the user; relative paths in the input are relative to its folder

  /// In the order of addition; created by add(), link() and connect(), read only.
  std::vector<Structure> structures;
  std::vector<Link> links;
  std::vector<Device> devices;

  /// Adds a named structure. Throws ModelError for a name that is in use or not allowed in files, and for options that
  /// are missing, duplicate, out of range or not applicable to this structure.
  StructureHandle add(const std::string& name, Structure structure, const StructureOptions& options = {});

  /// Links two structures, the left one first. For drawn frames, the facing sides and the gap follow from the drawing.
  /// Throws ModelError for invalid ends, floors, gaps and laws, and if they contradict the drawing.
  void link(const ContactLocation& left, const ContactLocation& right, const LinkOptions& options,
            const ContactLaw& law);

  /// Connects two structures by a named device, the left one first. Two nodes of drawn frames are connected along the
  /// line between them; all other ends along the horizontal axis in which links act. Throws ModelError for invalid
  /// ends, ends without mass along the device, and numbers out of range.
  void connect(const std::string& name, const ContactLocation& left, const ContactLocation& right,
               const DeviceOptions& options);

  /// Connects two points of one structure by a device, which becomes one of its yielding parts and does not enter its
  /// damping. `along`: the line between two nodes; the default is `along` between nodes and x otherwise. Both nodes of
  /// a damper must move a mass. Throws ModelError like connect(), and for a structure with differently moving supports
  /// or with large rotations.
  void connect_within(const std::string& name, const StructureHandle& structure, const DeviceEnd& from,
                      const DeviceEnd& to, std::optional<DeviceAxis> axis, const DeviceOptions& options);

  /// Sets defaults (duration, output step), applies the ground motion to the structures and validates the model. A run
  /// does this automatically; a direct call of assemble() requires it first. Nothing can be added afterwards; a second
  /// call has no effect. Throws ModelError.
  void complete();
  bool is_complete() const noexcept { return is_complete_; }

  /// True if the ground motion of a complete model may be replaced: no support has a delay, and the motion is not a
  /// travelling wave.
  bool can_move_otherwise() const noexcept;
  /// Replaces the ground motion of a complete model. Duration and output step follow from the new motion unless given.
  /// Throws ModelError like complete(), and std::logic_error if can_move_otherwise() is false or the new motion is a
  /// wave.
  void move_otherwise(const GroundSection& other);

 private:
  // Ground motion options of one structure.
  struct OwnGround {
    double delay;
    std::optional<GroundComponents> motion;
  };
  void require_open() const;
  std::vector<Support> supports_on_ground(int structure) const;
  void put_on_ground();
  void check_ground() const;
  void check_settings() const;
  void fill_in_times();

  std::vector<OwnGround> own_ground_;
  double given_duration_ = 0, given_output_step_ = 0;
  bool is_on_ground_ = false, is_complete_ = false;
};

/// Throws ModelError for a structure name that is not allowed in files.
void require_structure_name(const std::string& name);

/// Structures that are integrated together.
struct Assembly {
  std::vector<int> structures{};  ///< indices, increasing; empty for all of the model
  bool with_links = true;         ///< false omits the links but not the devices
};

/// Equations of motion of a complete model or of some of its structures, with the links and devices between them. The
/// model owns the contacts and elements, and must outlive the system. Walls belong to every assembly. Throws
/// std::invalid_argument for a link or device to a structure that is not included.
System assemble(const Model& model, const Assembly& assembly);
/// Of all structures. `with_links` false omits the links
/// but not the devices.
System assemble(const Model& model, bool with_links = true);

/// First unknown of each structure in the assembled system.
std::vector<int> offsets(const Model& model);

/// Initial displacements and velocities of the assembled system. Without links, preloads cause no displacement.
std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model, const Assembly& assembly);
inline std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model, bool with_links = true) {
  return initial_state(model, Assembly{.with_links = with_links});
}

/// Structures joined by bars: their indices, and the lowest frequencies of the joint system, increasing [rad/s].
struct JoinedByBars {
  std::vector<int> structures;
  Eigen::VectorXd frequencies;  ///< empty without bars
};
JoinedByBars joined_by_bars(const Model& model);

/// One line on the periods of structures joined by bars; empty if there are none. Periods of single structures exclude
/// the bars.
std::string describe_joined(const Model& model);

/// One line on a device: its parts and its ends.
std::string describe(const Model& model, const Device& device);
/// Text on the parts of a device: "bar 50 MN/m, damper 200 kN s/m".
std::string describe(const DeviceParts& parts);

}  // namespace pounding
