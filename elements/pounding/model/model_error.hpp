#pragma once
/// The error of a wrong model, which knows the option that it concerns.

#include <stdexcept>
#include <string>

namespace pounding {

/// The option of a model, of a structure or of a link that an error is about.
enum class ModelOption {
  // of the model
  analysis,
  checkpoint,
  accept,
  structures,
  wave,
  ground_component,
  // of a structure
  structure,
  name,
  damping,
  initial_displacement,
  initial_node_displacements,
  initial_velocity,
  forces,
  delay,
  face,
  // of a link
  link,
  between,
  within,
  left,
  right,
  floors,
  level_within,
  gap,
  preload,
  link_name,
  points,
  friction,
  sliding_velocity,
  reduced_mass,
  law,
  // of a device
  device,
  device_name,
  bar,
  device_law,
  damper,
  axis
};

/// A model that cannot be. The text says what is wrong and what to give; a reader of inputs finds by the option where
/// in its file that stands.
class ModelError : public std::invalid_argument {
 public:
  ModelError(ModelOption option, const std::string& text) : std::invalid_argument(text), option_(option) {}
  /// An option of the structure with this number.
  ModelError(ModelOption option, int structure, const std::string& text)
      : std::invalid_argument(text), option_(option), structure_(structure) {}
  /// An option that should not be there at all.
  ModelError as_idle() const {
    ModelError copy = *this;
    copy.is_idle_ = true;
    return copy;
  }
  /// The error of one item of several, numbered from 0.
  ModelError of(int item) const {
    ModelError copy = *this;
    copy.item_ = item;
    return copy;
  }
  /// A motion of the ground along this axis, 0 for x.
  ModelError along(int axis) const {
    ModelError copy = *this;
    copy.axis_ = axis;
    return copy;
  }

  ModelOption option() const noexcept { return option_; }  ///< that is wrong
  int structure() const noexcept { return structure_; }    ///< -1: of none, or of one that is not in the model yet
  int axis() const noexcept { return axis_; }              ///< of a motion of the ground, 0 for x
  int item() const noexcept { return item_; }              ///< among several of an option, from 0
  bool is_idle() const noexcept { return is_idle_; }       ///< whether the option should not be there

 private:
  ModelOption option_;
  int structure_ = -1, axis_ = 0, item_ = 0;
  bool is_idle_ = false;
};

}  // namespace pounding
