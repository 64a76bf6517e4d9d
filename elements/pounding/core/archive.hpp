#pragma once
/// State as bytes, for rejected steps and checkpoints. One function lists the fields, for both writing and reading.
/// archive_eigen.hpp adds matrices.

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pounding {

class Archive;

/// A class that lists the members of its state.
template <class T>
concept Archived = requires(T& value, Archive& archive) { value.archive(archive); };

/// A value whose bytes are its state. A class with an archive function may contain references, whose bytes cannot be
/// restored.
template <class T>
concept PlainBytes = std::is_trivially_copyable_v<T> && !Archived<T>;

/// `archive(x)` appends x when writing and replaces it when reading, bitwise identical. The bytes are not portable:
/// they are read on the same kind of machine, by the same version of the program.
class Archive {
 public:
  /// Creates an empty archive, for writing.
  Archive() = default;
  /// Creates an archive of these bytes, for reading.
  explicit Archive(std::vector<std::byte> bytes) : bytes_(std::move(bytes)), reading_(true) {}

  /// True when reading; and the bytes that were written or will be read.
  bool reading() const { return reading_; }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  /// Restarts: empties the archive for writing but keeps its memory, or reads again from the first byte.
  void rewind_for_writing() {
    bytes_.clear();
    reading_ = false;
    position_ = 0;
  }
  void rewind_for_reading() {
    reading_ = true;
    position_ = 0;
  }
  /// Throws std::runtime_error unless all bytes were read.
  void expect_end() const {
    if (position_ != bytes_.size()) throw std::runtime_error("the saved state has unexpected bytes at its end");
  }

  /// Values, lists and strings, with their sizes. Throws std::runtime_error if the bytes end early.
  template <PlainBytes T>
  void operator()(T& value) {
    raw(&value, sizeof(T));
  }
  template <PlainBytes T>
  void operator()(std::vector<T>& values) {
    values.resize(count(values.size()));
    raw(values.data(), sizeof(T) * values.size());
  }
  template <class T>
    requires(!PlainBytes<T>)
  void operator()(std::vector<T>& values) {
    values.resize(count(values.size()));
    for (T& value : values) (*this)(value);
  }
  void operator()(std::string& text) {
    text.resize(count(text.size()));
    raw(text.data(), text.size());
  }
  /// A class with a member `void archive(Archive&)`.
  template <Archived T>
  void operator()(T& value) {
    value.archive(*this);
  }
  /// A type of another library: `archive_value(Archive&, T&)` in this namespace, as in archive_eigen.hpp.
  template <class T>
    requires requires(T& value, Archive& archive) { archive_value(archive, value); }
  void operator()(T& value) {
    archive_value(*this, value);
  }

  /// Several values, one after another.
  template <class... T>
    requires(sizeof...(T) > 1)
  void operator()(T&... values) {
    ((*this)(values), ...);
  }

  /// The parts that such a function is made of. A number of items: written, or read and returned. Throws
  /// std::runtime_error for a number that the bytes cannot hold.
  std::size_t count(std::size_t size) {
    (*this)(size);
    if (reading_ && size > bytes_.size()) throw std::runtime_error("the saved state is damaged");
    return size;
  }
  /// `size` bytes at `data`: written, or read into that memory.
  void raw(void* data, std::size_t size) {
    if (size == 0) return;
    if (!reading_) {
      const auto* first = static_cast<const std::byte*>(data);
      bytes_.insert(bytes_.end(), first, first + size);
      return;
    }
    if (position_ + size > bytes_.size()) throw std::runtime_error("the saved state ends early");
    std::memcpy(data, bytes_.data() + position_, size);
    position_ += size;
  }

 private:
  std::vector<std::byte> bytes_;
  bool reading_ = false;
  std::size_t position_ = 0;
};

}  // namespace pounding
