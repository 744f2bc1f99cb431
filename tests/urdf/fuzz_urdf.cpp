// SPDX-License-Identifier: Apache-2.0
/// @file Feeds the URDF loader with anything. It must answer with a robot or a FileError, and with
/// nothing else.
#include <articula/urdf/urdf.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

template <int N>
void load(std::string_view text, const articula::UrdfOptions& options) {
  try {
    const articula::Model<N> model = articula::load_urdf<N>(text, options);
    if (model.links.empty()) __builtin_trap();
  } catch (const articula::FileError&) {  // the right answer
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // '<' in front, so that it is taken for XML and not for a file's name.
  std::string text = "<";
  text.append(reinterpret_cast<const char*>(data), size);  // NOLINT: bytes are characters
  if (text.starts_with("<<")) text.erase(0, 1);
  load<1>(text, {});
  load<2>(text, {.root = "a", .allow_unphysical = true});
  try {
    static_cast<void>(articula::load_kinematic_urdf<1>(text));
  } catch (const articula::FileError&) {  // the right answer
  }
  load<1>(text, {.tip = "b", .locked = {{"i", 0.5}}, .allow_unphysical = true});
  return 0;
}
