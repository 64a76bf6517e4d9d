/// `reproduce`: computed here, drawn and typeset by Python.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/results/replaced_file.hpp>
#include "commands.hpp"
#include "python_process.hpp"
#include "reproduce/items.hpp"

namespace pounding::program {
namespace {

namespace fs = std::filesystem;
using reproduce::Item, reproduce::ItemMaker, reproduce::Verdict;

struct ReproduceArguments {
  std::vector<std::string> only;
  std::string directory = "reproduction";
  bool json = false;
};

std::vector<const ItemMaker*> chosen(const std::vector<std::string>& only) {
  std::vector<const ItemMaker*> result;
  for (const std::string& name : only) reproduce::item_maker(name);  // throws for an unknown name
  for (const ItemMaker& maker : reproduce::item_makers())
    if (only.empty() || std::ranges::find(only, maker.name) != only.end()) result.push_back(&maker);
  return result;
}

// The report of an earlier reproduction marks the folder.
const FileKind report_files{"report of a reproduction", "-o FOLDER",
                            [](std::string_view start) { return start.starts_with("{\"items\":"); }};
const FileKind figure_files{"figure", "-o FOLDER", [](std::string_view) { return true; }};

void write(const fs::path& file, const std::string& text, const FileKind& kind) {
  ReplacedFile(file.string(), kind).replace(std::as_bytes(std::span(text)));
}

/// Throws InputError for a nonempty folder without an earlier report: its files may belong to other programs.
void require_own(const fs::path& directory, const fs::path& data) {
  ReplacedFile(data.string(), report_files).require_free();
  std::error_code error;
  if (!fs::is_empty(directory, error) && !error && !fs::exists(data))
    throw InputError(
        fmt::format("-o {}: the folder contains files but no report of a reproduction. Type a new folder, such as -o "
                    "{}/reproduction",
                    directory.string(), directory.string()));
}

/// Writes one terminal line, which the next call overwrites.
void show(const std::string& text) {
  if (isatty(STDERR_FILENO) != 0) std::fputs(("\r\033[K" + text).c_str(), stderr);
}

/// Clears the line on destruction, also after an exception.
struct ProgressLine {
  ~ProgressLine() { show(""); }
};

void print(const std::vector<Item>& items, const std::string& report) {
  int counts[3] = {0, 0, 0};
  for (const Item& item : items) {
    fmt::print("{}: {} ({})\n", item.name, item.title, item.sections);
    for (const Verdict& v : item.verdicts) {
      ++counts[static_cast<int>(v.judgement)];
      fmt::print("  {:<18}  {}\n", word(v.judgement), v.place);
    }
    fmt::print("\n");
  }
  fmt::print("{} agree, {} do not agree, {} cannot be checked\nreport       {}\n", counts[0], counts[1], counts[2],
             report);
}

void print_json(const std::vector<Item>& items, const std::string& report) {
  nlohmann::json list = nlohmann::json::array();
  for (const Item& item : items) {
    nlohmann::json verdicts = nlohmann::json::array();
    for (const Verdict& v : item.verdicts)
      verdicts.push_back(
          {{"place", v.place}, {"judgement", word(v.judgement)}, {"printed", v.printed}, {"ours", v.ours}});
    list.push_back({{"name", item.name}, {"verdicts", verdicts}});
  }
  fmt::print("{}\n", nlohmann::json{{"report", report}, {"items", list}}.dump());
}

std::vector<Item> compute_and_draw(const std::vector<const ItemMaker*>& makers, const fs::path& directory,
                                   const fs::path& data, const fs::path& report) {
  const ProgressLine line;
  std::vector<Item> items;
  std::vector<double> seconds;
  for (const ItemMaker* maker : makers) {
    show(fmt::format("[{}/{}] {}: {} ", items.size() + 1, makers.size(), maker->name, maker->title));
    const auto begin = std::chrono::steady_clock::now();
    items.push_back(maker->make());
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    for (const reproduce::Figure& figure : items.back().figures)
      write(directory / (figure.name + ".csv"), to_csv(figure), figure_files);
  }
  write(data, to_json(items, seconds), report_files);
  show("drawing ");
  run_python({.module = "_reproduce", .product = "report"}, {"-o", report.string()}, {data.string()});
  return items;
}

void reproduce_paper(const ReproduceArguments& arguments) {
  const std::vector<const ItemMaker*> makers = chosen(arguments.only);
  const fs::path directory = arguments.directory;
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw InputError(fmt::format("-o {}: the folder cannot be created: {}", arguments.directory, error.message()));

  const fs::path data = directory / "report.json", report = directory / "report.html";
  require_own(directory, data);
  const petsc::Environment environment;
  const std::vector<Item> items = compute_and_draw(makers, directory, data, report);
  arguments.json ? print_json(items, report.string()) : print(items, report.string());
}

}  // namespace

void add_reproduce(CLI::App& app) {
  const auto arguments = std::make_shared<ReproduceArguments>();
  CLI::App* command = app.add_subcommand(
      "reproduce", "Recompute Naderpour, Barros & Khatami 2015, with a verdict on each equation, table and figure");
  std::string names;
  for (const ItemMaker& maker : reproduce::item_makers())
    names += (names.empty() ? "" : ", ") + std::string(maker.name);
  command->add_option("--only", arguments->only, "Parts of the paper, separated by commas: " + names)->delimiter(',');
  names_a_file(command->add_option("-o,--output", arguments->directory,
                                   "Folder for report.html, report.json and the figures as PNG and CSV"))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print the verdicts as one JSON object");
  command->callback([arguments] { reproduce_paper(*arguments); });
}

}  // namespace pounding::program
