#pragma once
/// What is simulated: structures beside each other, the links between them, the motion of the ground.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pounding/links/contact.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/input/input.hpp>
#include <pounding/model/scheme.hpp>
#include <pounding/structures/structure.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// A value that a report or resolved.yaml shows.
struct Value {
  std::string name;
  double value = 0;
  std::string unit;
};

/// One side of a link.
struct LinkEnd {
  int structure = 0;   ///< from 0
  int floor = -1;      ///< from 0; -1 for a wall, a node, and a point between floors
  std::string label;   ///< "floor 3", "node b", "10.5 m up"; empty for a wall
  ContactPoint point;
};

/// One contact between two points that face each other.
struct Link {
  std::string name;
  LinkEnd left, right;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< from left to right
  double gap = 0;  ///< [m]
  std::string law, formula;
  double reduced_mass = 0;  ///< that the damping was calibrated with [kg]
  bool reduced_mass_given = false;
  std::vector<Value> parameters;  ///< of the law, calibrated damping included
  double friction = 0;            ///< Coulomb's coefficient
  double sliding_velocity = 0;    ///< of its regularisation, see Friction [m/s]
  std::unique_ptr<Contact> contact;
};

/// Lowest modes that are found of every structure.
inline constexpr int modes_of_a_structure = 6;

/// Below the first the rounding of the arithmetic is larger than the error; above the second an impact is not resolved.
inline constexpr double min_tolerance = 1e-10, max_tolerance = 0.1;

/// How a model is integrated in time: the section `analysis` of the input. PETSc options may change tolerance and scheme.
struct AnalysisSettings {
  double duration = 0;      ///< of the run, which starts at time 0 [s]
  double tolerance = 1e-4;  ///< local error relative to the motion and to link forces [-], in [min_tolerance, max_tolerance]
  double output_step = 0;   ///< spacing of the output times, the first being 0 [s]
  Scheme scheme;            ///< scheme of the time stepping
  double max_step = 0;      ///< longest step [s]; 0: from the record's spacing, else from the shortest period of the model
};

/// How often a run at least leaves a state to go on from; the results file is rewritten then. Zero: not asked for.
struct CheckpointSettings {
  double every = 0;            ///< of run time [s]
  double every_simulated = 0;  ///< of simulated time [s]

  /// Whether the input says anything.
  bool asked() const { return every > 0 || every_simulated > 0; }
};

/// All that an input says, read and checked.
struct Model {
  std::string title;
  GroundSection ground;
  std::vector<Structure> structures;
  std::vector<Link> links;
  AnalysisSettings analysis;
  CheckpointSettings checkpoint;
  bool compare_no_pounding = false;
  std::string source_text;  ///< the input as given
  std::string source_file;  ///< as the user named it; relative paths in the input start from its folder
};

/// How a structure of one kind is read: `body` is the node under the word. What stands beside the word for every kind
/// (damping, initial motions, delay) is left to the reader of models.
struct StructureKind {
  std::string_view word;
  Structure (*read)(const Input& body);
};

/// What a link's law is.
struct LinkLaw {
  std::string law, formula;
  double reduced_mass = 0;
  bool reduced_mass_given = false;
  std::vector<Value> parameters;
  /// Makes a contact of this law; called once a link.
  std::unique_ptr<Contact> contact;
};

/// What can stand in an input. The elements library fills it; the reader knows no concrete element.
struct Kinds {
  std::span<const StructureKind> structures;
  /// Reads the law of a link; the keys that belong to the link itself are in `link_keys`. The masses are those of its two
  /// ends, infinite for a wall [kg].
  LinkLaw (*read_law)(const Input& link, std::span<const std::string_view> link_keys, double gap, double left_mass,
                      double right_mass, int index);
};

/// Reads and checks a whole model; `modes` finds what Rayleigh damping and the first periods need. Throws InputError with
/// file, line and column.
Model read_model(const Input& input, const Kinds& kinds, const ModeSolver& modes = dense_modes);

/// The equations of motion. The contacts and springs stay the model's; the springs start undeformed, whatever an earlier
/// run has left in them. `with_links` false leaves the links out.
System assemble(const Model& model, bool with_links = true);

/// First unknown of each structure in the assembled system.
std::vector<int> offsets(const Model& model);

/// Initial displacements and velocities of the assembled system.
std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model);

/// What a run is about, one line each: title, ground motions, links with their laws, gaps and masses.
std::string describe(const Model& model);

/// The model with every default and calibrated parameter filled in, SI, as YAML.
std::string resolved_yaml(const Model& model);

}  // namespace pounding
