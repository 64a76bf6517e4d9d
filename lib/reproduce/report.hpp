#pragma once
/// Findings of a reproduction of the paper as data: figures, tables, matrices and verdicts. Python plots and typesets
/// them.
///
/// The paper: Naderpour, Barros & Khatami 2015, Scientia Iranica, Transactions A. Texts may contain mathematics between
/// dollar signs, in the TeX subset of matplotlib.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace pounding::reproduce {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();  ///< an empty cell

/// Values of one quantity. Columns of a figure may have different lengths.
struct Column {
  std::string name, unit;  ///< unit empty for a pure number
  std::vector<double> values;
};

/// A line through points of two columns of its figure.
struct Curve {
  std::string label;  ///< empty: not in the legend
  std::string x, y;   ///< names of columns
  enum class Kind { line, thin, dashed, points } kind = Kind::line;
};

struct Panel {
  std::string title, x_label, y_label;  ///< labels with their units
  std::vector<Curve> curves;
  bool x_log = false, y_log = false;
};

/// A figure; its columns are plotted and written to NAME.csv.
struct Figure {
  std::string name;      ///< base name of its files: "cyclic_velocity"
  std::string of_paper;  ///< "Fig. 11"; empty if the paper has none
  std::string caption;
  std::vector<Column> columns{};
  std::vector<Panel> panels{};

  /// Appends one column and returns its name.
  const std::string& add(std::string column, std::string unit, std::vector<double> values);
  /// Adds two columns and a curve to the last panel. The names of the columns consist of the panel number and the
  /// label.
  void plot(const std::string& label, std::vector<double> x, std::vector<double> y,
            Curve::Kind kind = Curve::Kind::line);
  const Column& column(std::string_view column) const;  ///< throws std::out_of_range
};

/// A table: a first column of text, then columns of numbers.
struct Table {
  std::string name, title;
  std::string row_header;  ///< header of the text column
  struct Heading {
    std::string name, unit;
    int decimals = 4;  ///< shown; -3: three significant digits, for values that differ by powers of ten
  };
  std::vector<Heading> headings{};
  struct Row {
    std::string name;
    std::vector<double> values;  ///< NaN: no value
  };
  std::vector<Row> rows{};

  double at(std::string_view row, std::string_view heading) const;  ///< throws std::out_of_range
};

struct Matrix {
  std::string name, unit;  ///< name in mathematics
  std::vector<std::vector<double>> rows{};
};

struct Equation {
  std::string number, tex;  ///< "16"
};

/// Verdict on a claim of the paper.
enum class Judgement { agrees, disagrees, cannot_be_checked };

struct Verdict {
  std::string place;  ///< "Eq. 4", "Table 2", "Fig. 12"
  std::string claim, printed, ours;
  Judgement judgement = Judgement::agrees;
  std::string reason;  ///< accuracy of the agreement, likely cause of the difference, or missing information
};

/// One item of the paper.
struct Item {
  std::string name, title, sections;  ///< `name` is the argument of --only
  std::vector<std::string> paragraphs{};
  std::vector<Equation> equations{};
  std::vector<Matrix> matrices{};
  std::vector<Figure> figures{};
  std::vector<Table> tables{};
  std::vector<Verdict> verdicts{};

  const Figure& figure(std::string_view figure) const;  ///< throws std::out_of_range
  const Table& table(std::string_view table) const;
  const Verdict& verdict(std::string_view place) const;  ///< the first verdict on this place
};

std::string_view word(Judgement judgement);  ///< "agrees", "does not agree", "cannot be checked"

/// The JSON object of report.json, documented on the Python page; `seconds` is the run time of each item.
std::string to_json(const std::vector<Item>& items, const std::vector<double>& seconds);
/// CSV text: adjacent columns, units in the header, empty cells below shorter columns.
std::string to_csv(const Figure& figure);

}  // namespace pounding::reproduce
