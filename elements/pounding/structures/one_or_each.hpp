#pragma once
/// A single value for all storeys, floors or links, or a list of values.

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pounding {

/// Constructed from a number or a list: `.stiffness = 350e6`, `.stiffness = {400e6, 350e6, 300e6}`.
class OneOrEach {
 public:
  /// Not given.
  OneOrEach() = default;
  OneOrEach(double one) : values_{one} {}
  OneOrEach(std::initializer_list<double> each) : values_(each) {}
  OneOrEach(std::vector<double> each) : values_(std::move(each)) {}

  bool empty() const noexcept { return values_.empty(); }  ///< true if not given
  /// Values of `count` items. Throws std::invalid_argument, naming `what`, for a list of a different length.
  std::vector<double> of_each(int count, const std::string& what) const {
    if (values_.size() == 1) return std::vector<double>(count, values_.front());
    if (static_cast<int>(values_.size()) != count)
      throw std::invalid_argument(what + ": give one value or a list of " + std::to_string(count) + "; " +
                                  std::to_string(values_.size()) + " given");
    return values_;
  }

 private:
  std::vector<double> values_;
};

}  // namespace pounding
