/// The board of an image whose hardware may have an encoder along the sliding.
#pragma once

#include <type_traits>

namespace sonoglide::image {

/// An encoder is in the images of scenes with a texture alone.
///
/// @tparam Hardware  has a Board, and a BoardWithEncoder where it was told of an encoder
/// @tparam Targets   of the scene
template <class Hardware, class Targets, class = void>
struct BoardOf {
  using Type = typename Hardware::Board;
};
template <class Hardware, class Texture>
struct BoardOf<Hardware, Texture,
               std::void_t<typename Hardware::BoardWithEncoder, typename Texture::Length>> {
  using Type = typename Hardware::BoardWithEncoder;
};

}  // namespace sonoglide::image
