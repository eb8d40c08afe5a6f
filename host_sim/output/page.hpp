/// A report page as data: what is said and drawn, not how.
#pragma once

#include <string>
#include <vector>

namespace sonoglide::output {

/// One curve; NaN leaves a gap.
struct Series {
  std::string label;
  std::vector<double> y;
  bool stepped = false;  ///< held until the next point instead of joined to it
  bool connect_gaps =
      false;            ///< joined across NaN: a branch of a loop that shares its x with others
  bool marked = false;  ///< each point is a dot
};

/// One chart; every series has one value for each entry of x, which never decreases.
///
/// An axis label ends with its unit in square brackets, "Displacement [m]"; a plain SI unit gets
/// the prefix that suits the range on show, any other a power of ten. "[-]" marks a pure number.
struct Panel {
  std::string title;
  std::string note;     ///< one or two sentences under the title; may be empty
  std::string x_label;  ///< with its unit
  std::string y_label;  ///< with its unit
  std::vector<double> x;
  std::vector<Series> series;
  bool logarithmic_y = false;
  std::string group;           ///< panels of one non-empty group zoom and hover together
  bool logarithmic_x = false;  ///< every x is above 0
};

/// A column of which at least half the cells are numbers is set flush right.
struct Table {
  std::string title;                ///< empty: none
  std::vector<std::string> header;  ///< empty: no heading row
  std::vector<std::vector<std::string>> rows;
};

/// A finished picture, shown as it is.
struct Picture {
  std::string title;
  std::string note;  ///< one or two sentences under the title; may be empty
  std::string svg;   ///< a whole SVG document
};

/// Tables, panels and pictures under one heading.
struct Section {
  std::string title;
  std::string text;
  std::vector<Panel> panels;
  std::vector<Picture> pictures = {};
  std::vector<Table> tables = {};
};

struct Page {
  std::string title;
  std::string lead;                   ///< what was run, in a sentence or two
  std::vector<std::string> warnings;  ///< shown first, set apart
  std::vector<Table> tables;
  std::vector<Section> sections;
};

/// The page as one self-contained HTML file: no network request, zoom and hover on every panel.
///
/// Ordinates are written with 7 significant digits, abscissae with as many as resolve 1e-7 of their
/// span. Once drawn, <body> carries data-panels (panels that have something to draw) and data-drawn
/// (charts whose canvas shows it), and each chart's <figure> its Dygraph as the property `chart`.
/// @throws std::invalid_argument if x decreases or is not finite, if a series has not one value for
/// each x, or a table row not one cell for each heading.
std::string to_html(const Page& page);

}  // namespace sonoglide::output
