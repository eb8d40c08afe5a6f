# The style, the scripts and the words of pages.
include(embed)

function(sonoglide_embed_page_assets target)
  foreach(asset IN ITEMS page.css numbers.js look.js chart.js reading.js panel.js wide.js page.js)
    string(REPLACE "." "_" function ${asset})
    sonoglide_embed(${target}
      HEADER host_sim/output/html.hpp
      NAMESPACE sonoglide::output
      FUNCTION ${function}
      FILE "${PROJECT_SOURCE_DIR}/host_sim/output/page/${asset}")
  endforeach()
  sonoglide_embed(${target}
    HEADER host_sim/output/html.hpp
    NAMESPACE sonoglide::output
    FUNCTION glossary_md
    FILE "${PROJECT_SOURCE_DIR}/host_sim/glossary.md")
  # Its limits and faults are words of the pages too.
  sonoglide_embed(${target}
    HEADER host_sim/output/html.hpp
    NAMESPACE sonoglide::output
    FUNCTION control_md
    FILE "${PROJECT_SOURCE_DIR}/firmware/control/README.md")
endfunction()
