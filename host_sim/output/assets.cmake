# The page's own style and script, and the chart library as Debian ships it.
include(embed)

find_file(SONOGLIDE_DYGRAPHS_JS dygraph.min.js
  PATHS /usr/share/javascript/dygraphs /usr/local/share/javascript/dygraphs
  DOC "dygraphs 2.2, minified")
find_file(SONOGLIDE_DYGRAPHS_CSS dygraph.min.css
  PATHS /usr/share/javascript/dygraphs /usr/local/share/javascript/dygraphs
  DOC "Style sheet of dygraphs 2.2, minified")
if(NOT SONOGLIDE_DYGRAPHS_JS OR NOT SONOGLIDE_DYGRAPHS_CSS)
  message(FATAL_ERROR
    "dygraphs was not found. Install libjs-dygraphs, or give -DSONOGLIDE_DYGRAPHS_JS=.../dygraph.min.js "
    "and -DSONOGLIDE_DYGRAPHS_CSS=.../dygraph.min.css.")
endif()

function(sonoglide_embed_page_assets target)
  set(folder "${PROJECT_SOURCE_DIR}/host_sim/output")
  foreach(asset IN ITEMS
      "page_css ${folder}/page.css"
      "page_js ${folder}/page.js"
      "dygraphs_css ${SONOGLIDE_DYGRAPHS_CSS}"
      "dygraphs_js ${SONOGLIDE_DYGRAPHS_JS}"
      "dygraphs_notice ${folder}/dygraphs_notice.txt")
    string(REGEX MATCH "^([^ ]+) (.+)$" ignored "${asset}")
    sonoglide_embed(${target}
      HEADER host_sim/output/assets.hpp
      NAMESPACE sonoglide::output
      FUNCTION ${CMAKE_MATCH_1}
      FILE "${CMAKE_MATCH_2}")
  endforeach()
endfunction()
