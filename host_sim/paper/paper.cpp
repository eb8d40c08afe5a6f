#include "host_sim/paper/paper.hpp"

#include <fmt/format.h>

#include <vector>

#include "host_sim/paper/balance.hpp"
#include "host_sim/paper/figures.hpp"
#include "host_sim/paper/paper_page.hpp"
#include "host_sim/paper/table_1.hpp"
#include "host_sim/report/output_folder.hpp"

namespace sonoglide::paper {
namespace {

std::vector<Figure> compute(std::optional<int> wanted, const Progress& progress) {
  std::vector<Figure> figures;
  double done = 0.0;
  for (const NumberedFigure& each : figure_list()) {
    if (!wanted || each.number == *wanted) {
      figures.push_back(each.compute());
    }
    done += 1.0;
    progress(done / static_cast<double>(figure_list().size()));
  }
  return figures;
}

}  // namespace

void write_paper(const std::filesystem::path& out, std::optional<int> figure,
                 const Progress& progress) {
  report::OutputFolder folder(out);
  const std::vector<Figure> figures = compute(figure, progress);
  for (const Figure& each : figures) {
    folder.write(fmt::format("figure_{:02}.csv", each.number), each.csv);
    folder.write(fmt::format("figure_{:02}.svg", each.number), each.svg);
    for (const File& file : each.files) {
      folder.write(file.name, file.text);
    }
  }
  Findings findings;
  if (!figure) {
    findings = {faults(), balances()};
    folder.write("balance.csv", balance_csv(findings.balances));
  }
  folder.write("table_1.toml", table_1_text());
  folder.write("table_2.toml", table_2_text());
  folder.write("index.html", report::to_html(paper_page(figures, findings)));
  folder.commit();
}

}  // namespace sonoglide::paper
