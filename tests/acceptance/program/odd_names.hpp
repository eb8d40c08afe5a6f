/// Names of scenes that somebody may think of, and what no output may hold.
#pragma once

#include <string>
#include <vector>

namespace sonoglide::acceptance {

/// Of files, without the ending; what one of them would run makes a file `pwned`.
inline const std::vector<std::string> odd_names = {
    "x'; system(\"touch pwned\") #",
    "don't",
    "''a''b'",
    "\"quoted\"",
    "$(touch pwned)",
    "`touch pwned`",
    "a;touch pwned;b",
    "%s%n%99999d",
    "@pwned",
    "{Bold a}_b^c",
    "*?[x] #error pwned ??",
    "back\\slash\\",
    "<script>alert(1)<!--",
    "a b",
    ".hidden",
    "..",
    "-dash",
    "--out",
    "a\n#error pwned\nb",
    "a\r\tb",
    "\x1b[31mred\x1b]0;title\a",
    "caf\xe9",
    "\xff\xfe\xc0\xaf",
    "\xe2\x80\xaetxt.exe",
    "µ-ζ",
    std::string(250, 'a'),
    std::string(124, '\xe9'),
};

/// Whether a text is lines of printable UTF-8.
bool is_printable(const std::string& text);

}  // namespace sonoglide::acceptance
