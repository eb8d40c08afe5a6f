#include "hal/template/board.hpp"
#include "product.hpp"

int main() {
  sonoglide::hal::template_board::Board board;
  run_product(board);
}
