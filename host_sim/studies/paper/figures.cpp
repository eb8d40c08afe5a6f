#include "host_sim/studies/paper/figures.hpp"

namespace sonoglide::paper {

const std::vector<NumberedFigure>& figure_list() {
  static const std::vector<NumberedFigure> list = {
      {2, figure_2}, {3, figure_3}, {4, figure_4},   {5, figure_5},   {6, figure_6},  {7, figure_7},
      {8, figure_8}, {9, figure_9}, {10, figure_10}, {11, figure_11}, {12, figure_12}};
  return list;
}

}  // namespace sonoglide::paper
