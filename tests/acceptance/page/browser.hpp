/// A page as a real browser, headless Chromium, sees it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::browser {

struct Visit {
  std::string dom;                    ///< the document after its scripts have run
  std::vector<std::string> requests;  ///< every URL that the page asked the network for
};

struct Screen {
  bool dark = false;
  int width_px = 1400;
};

/// Opens a page from its file, with a script appended to a copy of it if one is given.
///
/// Requests come from Chromium's own network log. Its chatter (updates, clock, accounts) bears no
/// initiator; what a document asks for bears that of the document, and it is these that are listed.
/// Loads of file: and data: URLs never reach the network stack, so they are not in the log.
/// @throws std::runtime_error if the browser fails or does not end.
Visit load(const std::filesystem::path& html, const std::string& script = "",
           const Screen& screen = {});

/// The value of an attribute of <body>, "" if it has none of that name.
std::string body_attribute(const std::string& dom, const std::string& name);

}  // namespace sonoglide::browser
