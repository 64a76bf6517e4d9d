#pragma once
/// State as bytes, for going back a step and for checkpoints: one function names the fields, for writing and for reading.

#include <Eigen/Core>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace pounding {

/// `archive(x)` appends x when writing and replaces it when reading. The bytes are the machine's own: what is read gives
/// the same bits, on the same kind of machine and by the same version of the program.
class Archive {
 public:
  /// For writing.
  Archive() = default;
  /// For reading.
  explicit Archive(std::vector<std::byte> bytes) : bytes_(std::move(bytes)), reading_(true) {}

  /// Whether it reads, and what was written so far or is read.
  bool reading() const { return reading_; }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  /// Starts over: writing into an empty archive, keeping its memory, or reading from the first byte.
  void rewind_for_writing() {
    bytes_.clear();
    reading_ = false;
    place_ = 0;
  }
  void rewind_for_reading() {
    reading_ = true;
    place_ = 0;
  }
  /// Throws std::runtime_error unless all was read.
  void expect_end() const {
    if (place_ != bytes_.size()) throw std::runtime_error("the saved state holds more than is expected");
  }

  /// Values, lists, texts and matrices, with their sizes. Throws std::runtime_error for bytes that end early.
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void operator()(T& value) {
    raw(&value, sizeof(T));
  }
  template <class T>
    requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& values) {
    values.resize(count(values.size()));
    raw(values.data(), sizeof(T) * values.size());
  }
  template <class T>
    requires(!std::is_trivially_copyable_v<T>)
  void operator()(std::vector<T>& values) {
    values.resize(count(values.size()));
    for (T& value : values) (*this)(value);
  }
  void operator()(std::string& text) {
    text.resize(count(text.size()));
    raw(text.data(), text.size());
  }
  template <int Columns>
  void operator()(Eigen::Matrix<double, Eigen::Dynamic, Columns>& m) {
    const std::size_t rows = count(static_cast<std::size_t>(m.rows())), columns = count(static_cast<std::size_t>(m.cols()));
    m.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    raw(m.data(), sizeof(double) * static_cast<std::size_t>(m.size()));
  }
  /// A class with a member `void archive(Archive&)`.
  template <class T>
    requires requires(T& value, Archive& archive) { value.archive(archive); }
  void operator()(T& value)
    requires(!std::is_trivially_copyable_v<T>)
  {
    value.archive(*this);
  }

 private:
  std::size_t count(std::size_t size) {
    (*this)(size);
    if (reading_ && size > bytes_.size()) throw std::runtime_error("the saved state is damaged");
    return size;
  }
  void raw(void* data, std::size_t size) {
    if (size == 0) return;
    if (!reading_) {
      const auto* first = static_cast<const std::byte*>(data);
      bytes_.insert(bytes_.end(), first, first + size);
      return;
    }
    if (place_ + size > bytes_.size()) throw std::runtime_error("the saved state ends early");
    std::memcpy(data, bytes_.data() + place_, size);
    place_ += size;
  }

  std::vector<std::byte> bytes_;
  bool reading_ = false;
  std::size_t place_ = 0;
};

}  // namespace pounding
