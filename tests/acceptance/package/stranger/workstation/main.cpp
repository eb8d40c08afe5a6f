// The controller without its hardware: it has to raise the drive of a contact that always rubs, and
// to report no fault.
#include <cstdint>
#include <cstdio>

#include "hal/board.hpp"
#include "product.hpp"

namespace {

/// Friction stays what it is without the drive; its last bits move, as those of a converter do.
class Board {
 public:
  bool sample(sonoglide::hal::Sample& sample) {
    const std::int32_t friction = half_of_full_scale + static_cast<std::int32_t>(period_ % 2 << 16);
    sample = {friction, tenth_of_full_scale, false, true};
    return ++period_ < periods;
  }

  void drive(const sonoglide::hal::Drive& drive) { last_ = drive; }

  const sonoglide::hal::Drive& last() const { return last_; }

 private:
  static constexpr std::int32_t half_of_full_scale = INT32_C(1) << 30;
  static constexpr std::int32_t tenth_of_full_scale = 0x0ccccccd;
  static constexpr std::uint32_t periods = 20;

  std::uint32_t period_ = 0;
  sonoglide::hal::Drive last_{};
};

}  // namespace

int main() {
  Board board;
  run_product(board);
  std::printf("drive %.3f of full scale, fault %d\n", board.last().amplitude / 2147483648.0,
              board.last().fault);
  return board.last().amplitude > 0 && board.last().fault == 0 ? 0 : 1;
}
