#pragma once
/// SHA-256, to identify an input in reports.

#include <string>
#include <string_view>

namespace pounding {

/// SHA-256 of a text (FIPS 180-4): 64 hexadecimal digits, equal to those of `sha256sum`.
std::string sha256(std::string_view text);

}  // namespace pounding
