#pragma once
/// A model: structures beside each other, the links between them, the motion of the ground. Built by code or read from
/// an input (input/read_model.hpp). SI units.

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/core/limits.hpp>
#include <pounding/ground/components.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/model/contact_stiffness.hpp>
#include <pounding/model/forces.hpp>
#include <pounding/model/model_error.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/model/scheme.hpp>
#include <pounding/model/system.hpp>
#include <pounding/structures/device_spring.hpp>
#include <pounding/structures/one_or_each.hpp>
#include <pounding/structures/structure.hpp>
#include <pounding/structures/structure_damping.hpp>

namespace pounding {

class ContactLaw;

/// One side of a link.
struct LinkEnd {
  int structure = 0;  ///< from 0
  int floor = -1;     ///< from 0; -1 for a wall, a node, and a point between floors
  std::string label;  ///< "floor 3", "node b", "10.5 m up"; empty for a wall
  ContactPoint point;
  std::optional<double>
      face{};  ///< from the point outwards to the face that is hit [m]; nullopt: none was given, the two coincide
  std::string face_column{};  ///< column whose surface it is; empty if the distance was given
};

/// One contact between two points that face each other.
struct Link {
  std::string name;
  LinkEnd left, right;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< from left to right
  double gap = 0;                                        ///< [m]
  bool preload = false;                                  ///< presses from the start
  std::string law, formula;
  double reduced_mass = 0;  ///< that the damping was calibrated with [kg]
  bool reduced_mass_given = false;
  std::string stiffness_from;                   ///< how the stiffness was estimated; empty where it was given
  std::vector<laws::ResolvedValue> parameters;  ///< of the law, calibrated damping included
  double friction = 0;                          ///< Coulomb's coefficient
  double sliding_velocity = 0;                  ///< of its regularisation, see Friction [m/s]
  std::unique_ptr<Contact> contact;

  /// Whether one of its ends is on a structure, counted from 0.
  bool hits(int structure) const { return left.structure == structure || right.structure == structure; }
};

/// A bar or what yields by a law, a damper, or both beside each other between two structures: it always acts, both
/// ways. Gravity and preloads leave it undeformed.
struct Device {
  std::string name;
  LinkEnd left, right;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< along which it acts, from left to right
  std::optional<double> length;                          ///< that is drawn [m]
  DeviceParts parts;
  std::unique_ptr<DeviceSpring> member;
};

/// Below the first the rounding of the arithmetic is larger than the error; above the second an impact is not resolved.
inline constexpr double min_tolerance = 1e-10, max_tolerance = 0.1;

/// How a model is integrated in time. PETSc options may change tolerance and scheme.
struct AnalysisSettings {
  double duration = 0;      ///< of the run, which starts at time 0 [s]; 0: until the ground is still
  double tolerance = 1e-4;  ///< error relative to the motion and to link forces [-], in [min_tolerance, max_tolerance]
  double output_step = 0;  ///< spacing of the output times, the first being 0 [s]; 0: the shortest sample of the ground
                           ///< motions, without samples a thousandth of the duration
  Scheme scheme{};         ///< scheme of the time stepping
  double max_step = 0;  ///< longest step [s]; 0: from the record's spacing, else from the shortest period of the model
  long max_steps = limits::usual_steps;  ///< steps that the run may take, in [1, limits::most_steps]; it then ends and
                                         ///< can be resumed
  Reduction reduction{};                 ///< of all structures
  std::map<std::string, Reduction> reductions{};  ///< of structures by their names, where they differ
  double collapse_drift =
      0;  ///< size of the drift of a storey over its height at which the run ends, as done [-]; 0: none
};

/// How often a run at least leaves a state to go on from; the results file is rewritten then. Zero: not asked for.
struct CheckpointSettings {
  double every = 0;            ///< of run time [s]
  double every_simulated = 0;  ///< of simulated time [s]

  /// Whether anything is asked for.
  bool requested() const { return every > 0 || every_simulated > 0; }
};

/// Where a link touches a structure, to be found on its surface. Made by a StructureHandle.
struct ContactLocation {
  int structure = 0;                  ///< from 0
  std::optional<int> floor{};         ///< from 1 at the lowest
  std::optional<double> elevation{};  ///< of a point of a column [m]
  std::string node{};
  std::optional<Face> face{};  ///< instead of that of the structure
};

/// A structure of a model. Alone it stands for a wall, or for the one floor of a structure.
class StructureHandle {
 public:
  explicit StructureHandle(int number) : number_(number) {}
  /// Its place in Model::structures.
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

/// A displacement of a node of a frame at the start.
struct NodeDisplacement {
  std::string node;
  std::string dof = "ux";  ///< ux ... rz
  double value = 0;        ///< [m], [rad]
};

/// Options of a structure of any kind.
struct StructureOptions {
  /// Needed by every structure but bodies and walls, unless it was made with its damping; 0 for none.
  std::optional<Damping> damping{};
  /// Along x [m/s]: of the floors, one for all or one each from the ground up; of a frame as a whole.
  OneOrEach initial_velocity{};
  /// Along x [m]: of the floors, one for all or one each from the ground up. All else of a frame follows as if forces
  /// held the floors there.
  OneOrEach initial_displacement{};
  std::vector<NodeDisplacement> initial_node_displacements{};  ///< of a frame, instead; all else follows likewise
  std::vector<ForceOptions> forces{};                          ///< that act over time
  double delay = 0;                                            ///< the ground moves later here [s]
  std::optional<GroundComponents> ground_motion{};             ///< of its own instead of the model's
  std::optional<Face> face{};  ///< of a frame that is drawn by axes: distance to the faces at which it is hit
};

/// Which floors of two structures a link joins, instead of one pair.
enum class FacingFloors {
  all,    ///< every floor, which must face one of the other structure up to the lower roof
  level,  ///< floors that are level with one of the other structure
  any     ///< all up to the lower roof; those that face none hit the column there
};

/// Floors whose elevations differ by less are level, whatever their beams measure [m].
inline constexpr double usual_level = 0.05;

/// Options of a link beside its law.
struct LinkOptions {
  /// >= 0, or < 0 with a preload [m]; with `floors` one for all or one each from the ground up. Between frames it may
  /// be left out: it is the distance drawn between their faces, and one that differs from it is refused unless it is a
  /// preload.
  OneOrEach gap{};
  /// The two ends press from the start, where the gap is negative: undeformed they would overlap, and the run begins in
  /// static equilibrium with the structures pushed apart.
  bool preload = false;
  std::optional<FacingFloors> floors{};  ///< links all of these; without it the two ends name one pair
  /// Largest difference in elevation of two floors that are level [m]: by default the depth of the deeper beam, at
  /// least usual_level.
  std::optional<double> level_within{};
  /// "left.1-right.1" unless given; of several pairs the first is "name.1".
  std::optional<std::string> name{};
  /// Points along the common edge of floors in space, 1 to 100: two where the edges overlap, else one.
  std::optional<int> points{};
  std::optional<double> friction{};          ///< Coulomb's coefficient >= 0; needs a frame and a law with a force
  std::optional<double> sliding_velocity{};  ///< of the friction's regularisation [m/s]; 5 mm/s
  /// That the damping is calibrated with [kg]; that of the two ends' own masses unless the law or this says otherwise.
  std::optional<double> reduced_mass{};
  /// Estimates the stiffness of the law for the masses at the two ends, instead of the one that the law was given.
  std::optional<StiffnessEstimate> stiffness{};
};

/// A bar by its section: the stiffness is E A over the length that is drawn.
struct BarSection {
  double young = 0;  ///< E [Pa]
  double area = 0;   ///< A [m^2]
};

/// Parts of a device; at least one, and not a bar beside a law.
struct DeviceOptions {
  std::optional<std::variant<Bar, BarSection>> bar{};
  std::optional<hysteresis::Settings> law{};  ///< of yielding by its name, with its stiffness
  std::optional<Damper> damper{};
};

/// Along which a device inside one structure acts.
enum class DeviceAxis { along, x, y, z };

/// One end of a device inside one structure: a node, a floor, or the ground.
struct DeviceEnd {
  std::string node{};
  std::optional<int> floor{};  ///< from 1 at the lowest
};

/// Something in a model that can be and was probably not meant.
struct Warning {
  std::string name;  ///< that Model::accept silences it by
  std::string text;  ///< where, the number, and the likely cause
};

/// The source_text of a model that was not read from a text.
inline constexpr std::string_view built_by_code =
    "# This model was built by a program and not read from a file; resolved.yaml tells what it was.\n";

/// All that is simulated. Structures are added first, links and devices between them afterwards; ground, analysis and
/// the rest may be set at any time until the model is completed.
class Model {
 public:
  std::string title;
  GroundSection ground;
  AnalysisSettings analysis;
  CheckpointSettings checkpoint;
  bool compare_no_pounding = false;  ///< whether a run also runs the structures without links, before
  /// Multiplies the stiffness of every contact that is linked from now on, to see how the answer depends on it.
  double stiffness_factor = 1;
  std::vector<std::string> accept;     ///< names of the doubts, see warning_names.hpp, that are meant as they are
  std::vector<Warning> read_warnings;  ///< those of the reader, about how numbers were written
  /// Finds what damping and first periods need. petsc::lowest_modes does so for frames of many thousand unknowns.
  ModeSolver mode_solver = dense_modes;
  std::string source_text{built_by_code};  ///< the input as given
  std::string source_file;  ///< the file as the user named it; relative paths in the input start from its folder

  /// In the order they were added; made by add(), link() and connect(), to be read only.
  std::vector<Structure> structures;
  std::vector<Link> links;
  std::vector<Device> devices;

  /// Adds a structure under a name. Throws ModelError for a name that files cannot hold or that is taken, and for
  /// options that are missing, given twice, out of range or without a meaning for this structure.
  StructureHandle add(const std::string& name, Structure structure, const StructureOptions& options = {});

  /// Links two structures, the left one first. Geometry is the truth where it is drawn: the sides that face each other
  /// and the gap follow from where frames stand. Throws ModelError for ends, floors, gaps and laws that cannot be, and
  /// for what contradicts the drawing.
  void link(const ContactLocation& left, const ContactLocation& right, const LinkOptions& options,
            const ContactLaw& law);

  /// Connects two structures under a name by a device, the left one first. Two nodes of drawn frames are connected
  /// along the line between them; all other ends along the horizontal axis in which links act. Throws ModelError for
  /// ends that cannot be or have no mass along the device, and for numbers out of range.
  void connect(const std::string& name, const ContactLocation& left, const ContactLocation& right,
               const DeviceOptions& options);

  /// Connects two points of one structure by a device, which becomes one of its parts that yield and has no part in its
  /// damping. `along` is the line between two nodes; nothing stands for it between nodes, and for x else. Nodes of a
  /// damper move with mass. Throws ModelError as connect() does, and for a structure whose supports move differently or
  /// that turns.
  void connect_within(const std::string& name, const StructureHandle& structure, const DeviceEnd& from,
                      const DeviceEnd& to, std::optional<DeviceAxis> axis, const DeviceOptions& options);

  /// Fills in what was left out (duration, output step), lets the ground act on the structures and checks the whole. A
  /// run does this by itself; whoever assembles a model calls it before. Afterwards nothing can be added; a second call
  /// does nothing. Throws ModelError.
  void complete();
  bool is_complete() const noexcept { return is_complete_; }

  /// Whether another motion may take the place of the ground's in a complete model: supports have no delay, and no wave
  /// passes.
  bool can_move_otherwise() const noexcept;
  /// Lets the ground of a complete model move otherwise. Duration and output step follow from the new motion where they
  /// were left out. Throws ModelError as complete(), and std::logic_error where can_move_otherwise() is false or the
  /// other motion is a wave.
  void move_otherwise(const GroundSection& other);

 private:
  // Options of the ground under one structure.
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

/// Throws ModelError for a name of a structure that files cannot hold.
void require_structure_name(const std::string& name);

/// The equations of motion of a complete model. The contacts and springs stay the model's; the springs start
/// undeformed, whatever an earlier run has left in them. `with_links` false leaves the links out, and no device.
System assemble(const Model& model, bool with_links = true);

/// First unknown of each structure in the assembled system.
std::vector<int> offsets(const Model& model);

/// Initial displacements and velocities of the assembled system. Without its links nothing is displaced by a preload.
std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model, bool with_links = true);

/// Structures that bars join, as one: which ones, and the lowest frequencies that they have together, increasing
/// [rad/s].
struct JoinedByBars {
  std::vector<int> structures;
  Eigen::VectorXd frequencies;  ///< empty where no bar joins
};
JoinedByBars joined_by_bars(const Model& model);

/// One line on the periods of structures that bars join; empty where there are none. Those of structures by themselves
/// have no bars.
std::string describe_joined(const Model& model);

/// One line on a device: what it is, between which ends.
std::string describe(const Model& model, const Device& device);
/// The parts of a device in words: "bar 50 MN/m, damper 200 kN s/m".
std::string describe(const DeviceParts& parts);

}  // namespace pounding
