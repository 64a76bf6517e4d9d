#pragma once
/// A value for all storeys, floors or links alike, or a list with one each.

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pounding {

/// Made from one number or from a list: `.stiffness = 350e6`, `.stiffness = {400e6, 350e6, 300e6}`.
class OneOrEach {
 public:
  /// Nothing was given.
  OneOrEach() = default;
  OneOrEach(double one) : values_{one} {}
  OneOrEach(std::initializer_list<double> each) : values_(each) {}
  OneOrEach(std::vector<double> each) : values_(std::move(each)) {}

  bool empty() const noexcept { return values_.empty(); }  ///< whether nothing was given
  /// The value of each of `count` places. Throws std::invalid_argument, in the name of `what`, for a list of another
  /// length.
  std::vector<double> of_each(int count, const std::string& what) const {
    if (values_.size() == 1) return std::vector<double>(count, values_.front());
    if (static_cast<int>(values_.size()) != count)
      throw std::invalid_argument(what + ": give one value, or a list of " + std::to_string(count) + "; " +
                                  std::to_string(values_.size()) + " were given");
    return values_;
  }

 private:
  std::vector<double> values_;
};

}  // namespace pounding
