/// `plot`, and the pictures of other commands: drawn by Python.

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <pounding/core/error.hpp>
#include "program/commands.hpp"
#include "program/python_process.hpp"

namespace pounding::program {
namespace {

namespace fs = std::filesystem;

/// A temporary file, removed by the destructor.
class TemporaryFile {
 public:
  /// Throws InputError if no temporary file can be created.
  explicit TemporaryFile(const std::string& text) {
    std::error_code none;
    name_ = (fs::temp_directory_path(none) / "pounding-XXXXXX").string();
    const int file = mkstemp(name_.data());
    if (file < 0) throw InputError("no picture: " + name_ + " cannot be written. Set TMPDIR to a writable directory");
    close(file);
    std::ofstream stream(name_);
    stream << text;
    stream.close();
    if (!stream) {
      fs::remove(name_, none);
      throw InputError("no picture: " + name_ + " cannot be written. Set TMPDIR to a directory with free space");
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(name_, ignored);
  }

  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

}  // namespace

void draw(const std::string& results, const std::string& picture, const std::string& kind) {
  run_python({.module = "plots", .product = "picture"}, {"-o", picture, "--picture=" + kind}, {results});
}

void draw_json(const char* module, const std::string& json, const std::string& picture, const std::string& title) {
  const TemporaryFile file(json);
  std::vector<std::string> options{"-o", picture};
  if (!title.empty()) options.push_back("--title=" + title);
  run_python({.module = module, .product = "picture"}, options, {file.name()});
}

void add_plot(CLI::App& app) {
  struct Options {
    std::string results, picture, title, kind = "run", floors;
    bool compare = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("plot", "Draw a results file");
  command->add_option("results", options->results, "results file of `pounding run` or `pounding pushover`")->required();
  names_a_file(command->add_option("-o,--output", options->picture,
                                   "picture: .png, .pdf or .svg (default: RESULTS.png in the current folder; for other "
                                   "pictures RESULTS-model.png ...)"));
  command->add_option("--title", options->title, "title (default: that of the run)");
  command
      ->add_option("--picture", options->kind,
                   "run (histories and impacts), model (structures at rest), profiles (extremes over the height), plan "
                   "(a map of drifts and impacts of frames in space), loops (force over deformation of the six parts "
                   "with the largest dissipation, or of contacts if there are none), hinges (a map of yielded parts "
                   "and impacts), or one panel")
      ->check(CLI::IsMember({"run", "model", "profiles", "plan", "loops", "hinges", "displacement", "rotation", "gap",
                             "force", "energy", "contact_loops"}));
  command->add_option("--floors", options->floors, "floors whose displacements `--picture run` shows, such as A.3,B.2");
  command->add_flag("--compare", options->compare,
                    "also draw the run without links, dashed; profiles and plan always do if the file contains it");
  command->callback([options] {
    std::vector<std::string> arguments;
    if (!options->picture.empty()) arguments = {"-o", options->picture};
    if (!options->title.empty()) arguments.push_back("--title=" + options->title);
    if (options->kind != "run") arguments.push_back("--picture=" + options->kind);
    if (options->compare) arguments.push_back("--compare");
    if (!options->floors.empty()) arguments.push_back("--floors=" + options->floors);
    run_python({.module = "plots", .product = "picture", .prints = true}, arguments, {options->results});
  });
}

}  // namespace pounding::program
