#pragma once
/// What is simulated: structures beside each other, the links between them, the motion of the ground.

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pounding/contact.hpp>
#include <pounding/ground_motion.hpp>
#include <pounding/input.hpp>
#include <pounding/scheme.hpp>
#include <pounding/system.hpp>

namespace pounding {

/// What makes a storey yield, on top of its stiffness.
struct YieldingStorey {
  double yield_force = 0;  ///< [N]
  double hardening = 0;    ///< stiffness after the yield over that before it
  std::unique_ptr<Spring> spring;
  std::vector<std::byte> fresh;  ///< archive of the spring as it was given

  /// Takes a spring that has not been deformed.
  YieldingStorey(double force, double ratio, std::unique_ptr<Spring> undeformed);
};

/// One structure; displacements relative to the ground, one degree of freedom a floor. A wall has no floor at all.
struct Structure {
  std::string name;
  std::string kind;                 ///< the word of the input: oscillator, shear_building ...
  std::vector<std::string> floors;  ///< labels from the ground up
  Eigen::MatrixXd mass, damping, stiffness;
  std::vector<double> storey_stiffness;  ///< [N/m] from the ground up; empty for a body
  std::vector<YieldingStorey> yielding;  ///< one a storey from the ground up; empty when they stay elastic
  std::vector<double> heights;           ///< of the storeys from the ground up [m]; empty when not given
  Eigen::VectorXd initial_displacement, initial_velocity;
  std::string damping_note;  ///< how the damping matrix was made, one line

  int size() const { return static_cast<int>(mass.rows()); }
  bool is_rigid() const { return size() == 0; }
};

/// A value that a report or resolved.yaml shows.
struct Value {
  std::string name;
  double value = 0;
  std::string unit;
};

/// One contact between a floor on the left and a floor on the right; floor -1 is a wall.
struct Link {
  std::string name;
  int left = 0, left_floor = 0;    ///< structure and floor, from 0
  int right = 0, right_floor = 0;
  double gap = 0;  ///< [m]
  std::string law, formula;
  double reduced_mass = 0;  ///< that the damping was calibrated with [kg]
  bool reduced_mass_given = false;
  std::vector<Value> parameters;  ///< of the law, calibrated damping included
  std::unique_ptr<Contact> contact;
};

/// Below the first the rounding of the arithmetic is larger than the error; above the second an impact is not resolved.
inline constexpr double least_tolerance = 1e-10, largest_tolerance = 0.1;

struct AnalysisSettings {
  double duration = 0;           ///< [s]
  double tolerance = 1e-4;       ///< relative, on displacements and forces
  double output_step = 0;        ///< [s]
  Scheme scheme;                 ///< of time stepping
  double max_step = 0;           ///< longest step [s]; 0 lets the model decide
};

/// How often a run at least leaves a state to go on from; the results file is rewritten then. Zero: not asked for.
struct CheckpointSettings {
  double every = 0;            ///< of run time [s]
  double every_simulated = 0;  ///< of simulated time [s]

  bool asked() const { return every > 0 || every_simulated > 0; }
};

struct Model {
  std::string title;
  GroundMotion ground;
  std::vector<Structure> structures;
  std::vector<Link> links;
  AnalysisSettings analysis;
  CheckpointSettings checkpoint;
  bool compare_no_pounding = false;
  std::string source_text;  ///< the input as given
  std::string source_file;  ///< as the user named it; relative paths in the input start from its folder
};

/// How a structure of one kind is read: `body` is the node under the word, `place` the node of the structure.
struct StructureKind {
  std::string_view word;
  Structure (*read)(const Input& body);
};

/// How a link's law is read. `masses` are those of the two floors, infinite for a wall [kg].
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
  /// Reads the law of a link; the keys that belong to the link itself are in `link_keys`.
  LinkLaw (*read_law)(const Input& link, std::span<const std::string_view> link_keys, double gap, double left_mass,
                      double right_mass, int index);
};

/// Reads and checks a whole model. Throws InputError with file, line and column.
Model read_model(const Input& input, const Kinds& kinds);

/// The equations of motion. The contacts and springs stay the model's; the springs start undeformed, whatever an earlier
/// run has left in them. `with_links` false leaves the links out.
System assemble(const Model& model, bool with_links = true);

/// First unknown of each structure in the assembled system.
std::vector<int> offsets(const Model& model);

/// Initial displacements and velocities of the assembled system.
std::pair<Eigen::VectorXd, Eigen::VectorXd> initial_state(const Model& model);

/// The model with every default and calibrated parameter filled in, SI, as YAML.
std::string resolved_yaml(const Model& model);

}  // namespace pounding
