#include "host_sim/studies/identify/impedance/read_sweep.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "synthetic.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

constexpr double degrees = 360.0 / two_pi;

/// A file with a line for each of ten frequencies of the published piece.
std::string file_of(const std::string& heading,
                    const std::function<std::string(double f, Complex z)>& line,
                    const std::string& end = "") {
  std::string text = heading;
  const Circuit circuit = published_piece();
  for (int i = 0; i < 10; ++i) {
    const double f = 112e3 + 200.0 * i;
    text += line(f, 1.0 / circuit.admittance_S(f));
  }
  return text + end;
}

void expect_piece(const std::string& text, const std::string& file = "m.csv") {
  const Sweep sweep = read_sweep({file, text});
  ASSERT_EQ(sweep.frequency_Hz.size(), 10U);
  const Circuit circuit = published_piece();
  for (std::size_t i = 0; i < 10; ++i) {
    const double f = sweep.frequency_Hz[i];
    EXPECT_NEAR(f, 112e3 + 200.0 * static_cast<double>(i), 1e-6) << text;
    const Complex y = circuit.admittance_S(f);
    const Complex expected = sweep.has_phase ? y : Complex(std::abs(y));
    EXPECT_NEAR(std::abs(sweep.admittance_S[i] - expected), 0.0, 1e-7 * std::abs(y)) << text;
  }
}

std::string error_of(const std::string& text) {
  try {
    read_sweep({"m.csv", text});
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadSweep, KnowsColumnsByTheirNames) {
  const auto polar = [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f, std::abs(z), std::arg(z) * degrees);
  };
  for (const char* heading :
       {"frequency_Hz,impedance_magnitude_ohm,impedance_phase_deg\n",
        "Frequency(Hz), |Z|(Ohm)-data, theta-z(deg)-data\n", "f,Z,phase (deg)\n",
        "Freq [Hz],|Z| [\u03a9],\u03b8 [\u00b0]\n", "f/Hz,abs(Z)/Ohm,arg(Z)/deg\n"}) {
    expect_piece(file_of(heading, polar));
  }
  expect_piece(file_of("Frequency (kHz);|Z| (kOhm);Phase (rad)\n", [](double f, Complex z) {
    return fmt::format("{:.12g};{:.12g};{:.12g}\n", f / 1e3, std::abs(z) / 1e3, std::arg(z));
  }));
  expect_piece(file_of("freq_MHz,R_ohm,X_ohm\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f / 1e6, z.real(), z.imag());
  }));
  expect_piece(file_of("f (Hz)\tRe(Z)\t-Im(Z)\n", [](double f, Complex z) {
    return fmt::format("{:.12g}\t{:.12g}\t{:.12g}\n", f, z.real(), -z.imag());
  }));
  expect_piece(file_of("f (Hz),G (mS),B (uS)\n", [](double f, Complex z) {
    const Complex y = 1.0 / z;
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f, 1e3 * y.real(), 1e6 * y.imag());
  }));
  expect_piece(file_of("f (Hz),|Z| (dB)\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g}\n", f, 20.0 * std::log10(std::abs(z)));
  }));
  expect_piece(file_of("frequency_Hz,admittance_magnitude_S\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g}\n", f, 1.0 / std::abs(z));
  }));
}

TEST(ReadSweep, KnowsTouchstone) {
  const auto scattering = [](Complex z) { return (z - 50.0) / (z + 50.0); };
  expect_piece(file_of("! a piece\n# Hz S RI R 50\n", [&](double f, Complex z) {
    const Complex s = scattering(z);
    return fmt::format("{:.15g} {:.15g} {:.15g} ! a reading\n", f, s.real(), s.imag());
  }));
  expect_piece(file_of("",
                       [&](double f, Complex z) {
                         const Complex s = scattering(z);
                         return fmt::format("{:.15g} {:.15g} {:.15g}\n", f / 1e9, std::abs(s),
                                            std::arg(s) * degrees);
                       }),
               "x.s1p");
  expect_piece(file_of("# kHz s db r 50\n", [&](double f, Complex z) {
    const Complex s = scattering(z);
    return fmt::format("{:.15g}\t{:.15g}\t{:.15g}\n", f / 1e3, 20.0 * std::log10(std::abs(s)),
                       std::arg(s) * degrees);
  }));
  // Normalised to the reference resistance.
  expect_piece(file_of("# MHz Z RI R 75\n", [](double f, Complex z) {
    return fmt::format("{:.15g} {:.15g} {:.15g}\n", f / 1e6, z.real() / 75.0, z.imag() / 75.0);
  }));
  expect_piece(file_of("# Hz Y RI R 75\n", [](double f, Complex z) {
    const Complex y = 75.0 / z;
    return fmt::format("{:.15g} {:.15g} {:.15g}\n", f, y.real(), y.imag());
  }));
}

TEST(ReadSweep, TouchstoneWithoutOptionsIsAsTheStandardHasIt) {
  const auto lines = [](double f, Complex z) {
    const Complex s = (z - 50.0) / (z + 50.0);
    return fmt::format("{:.15g} {:.15g} {:.15g}\n", f / 1e9, std::abs(s), std::arg(s) * degrees);
  };
  expect_piece(file_of("#\n", lines), "x.s1p");
  EXPECT_TRUE(read_sweep({"x.s1p", file_of("#\n", lines)}).warnings.empty());
  const Sweep bare = read_sweep({"x.s1p", file_of("", lines)});
  ASSERT_EQ(bare.warnings.size(), 1U);
  EXPECT_NE(bare.warnings.front().find("no option line"), std::string::npos);
}

TEST(ReadSweep, KnowsTheExportOfA4294A) {
  const char* heading = "\"Frequency\"\t\"Data Trace Real\"\t\"Data Trace Imag\"\r\n";
  const std::string a = file_of(
      std::string("\"AN ANALYSER\"\r\n\r\n\"TRACE: A\"\r\n\"FORMAT: |Z|\"\r\n\r\n") + heading,
      [](double f, Complex z) { return fmt::format("{:.12g}\t{:.12g}\t0\r\n", f, std::abs(z)); });
  const std::string b =
      file_of(std::string("\r\n\"TRACE: B\"\r\n\"FORMAT: theta\"\r\n\r\n") + heading,
              [](double f, Complex z) {
                return fmt::format("{:.12g}\t{:.12g}\t0\r\n", f, std::arg(z) * degrees);
              });
  expect_piece(a + b);
  EXPECT_TRUE(read_sweep({"m.txt", a + b}).warnings.empty());
  expect_piece(a);
  EXPECT_NE(read_sweep({"m.txt", a}).warnings.at(0).find("no readings of trace B"),
            std::string::npos);
  const std::string complex_trace =
      file_of(std::string("\"TRACE: A\"\r\n") + heading, [](double f, Complex z) {
        return fmt::format("{:.12g}\t{:.12g}\t{:.12g}\r\n", f, z.real(), z.imag());
      });
  expect_piece(complex_trace);
}

TEST(ReadSweep, KnowsOrRefusesTheNamesOfTraces) {
  const auto traces = [](const std::string& one, const std::string& other) {
    const std::string heading = "\"\n\"Frequency\"\t\"Real\"\n";
    return file_of("\"TRACE: A\"\n\"FORMAT: " + one + heading,
                   [](double f, Complex z) {
                     return fmt::format("{:.12g}\t{:.12g}\n", f, 1.0 / std::abs(z));
                   }) +
           file_of("\n\"TRACE: B\"\n\"FORMAT: " + other + heading, [](double f, Complex z) {
             return fmt::format("{:.12g}\t{:.12g}\n", f, -std::arg(z) * degrees);
           });
  };
  expect_piece(traces("|Y|", "TH"));
  EXPECT_EQ(error_of(traces("|Y|", "X")),
            "m.csv:16:1: trace: \"|Y|\" and \"X\" are no pair of traces that is known; allowed: "
            "|Z|-theta, R-X, |Y|-theta, G-B");
  EXPECT_EQ(
      error_of("\"TRACE: A\"\n\"FORMAT: R\"\n\"Frequency\"\n1\t2\n"),
      "m.csv:2:1: trace: \"R\" alone, without trace B; allowed: |Z|-theta, R-X, |Y|-theta, G-B");
}

TEST(ReadSweep, ColumnsThatSayTheSameAgree) {
  const auto file = [](const char* names, double factor, double sign) {
    return file_of(std::string("f_Hz,|Z|,phase_deg,") + names + "\n", [&](double f, Complex z) {
      return fmt::format("{:.12g},{:.12g},{:.12g},{:.3g},{:.3g}\n", f, std::abs(z),
                         std::arg(z) * degrees, factor * z.real(), sign * factor * z.imag());
    });
  };
  expect_piece(file("R_ohm,X_ohm", 1.0, 1.0));
  for (const auto& text : {file("R_ohm,X_ohm", 3.0, 1.0), file("R_ohm,X_ohm", 1.0, -1.0)}) {
    EXPECT_NE(error_of(text).find("m.csv:2:"), std::string::npos) << error_of(text);
    EXPECT_NE(error_of(text).find("contradicts magnitude and phase of an impedance"),
              std::string::npos)
        << error_of(text);
  }
  EXPECT_EQ(
      error_of("f,|Z| (ohm),|Z| (kohm)\n1,2,3\n"),
      "m.csv:1:1: heading: \"|Z| (ohm)\" and \"|Z| (kohm)\" are the same; allowed: one of them");
}

TEST(ReadSweep, WarnsOfAFileThatMayBeCut) {
  std::string text = "f,|Z|\n";
  for (int i = 1; i <= 8; ++i) {
    text += fmt::format("{},{}\n", i, 100 + i);
  }
  EXPECT_TRUE(read_sweep({"m.csv", text}).warnings.empty());
  text.pop_back();
  EXPECT_NE(read_sweep({"m.csv", text}).warnings.at(0).find("has no line end"), std::string::npos);
}

TEST(ReadSweep, SortsAndAveragesReadingsOfOneFrequency) {
  std::string text = "f_Hz,|Y|\n";
  for (const int f : {9, 1, 3, 2, 5, 4, 6, 8, 7}) {
    text += fmt::format("{},{}\n", f, 100 + f);
  }
  EXPECT_TRUE(read_sweep({"m.csv", text}).warnings.empty());
  const Sweep sweep = read_sweep({"m.csv", text + "3,105\n"});
  ASSERT_EQ(sweep.frequency_Hz.size(), 9U);
  EXPECT_EQ(sweep.frequency_Hz[2], 3.0);
  EXPECT_EQ(sweep.admittance_S[2].real(), 104.0);
  EXPECT_EQ(sweep.frequency_Hz.back(), 9.0);
  ASSERT_EQ(sweep.warnings.size(), 1U);
  EXPECT_NE(sweep.warnings.front().find("10 readings at 9 frequencies"), std::string::npos);
}

TEST(ReadSweep, NamesThePlaceOfWhatIsWrong) {
  const auto begins = [](const std::string& text, const std::string& error) {
    EXPECT_EQ(error_of(text).substr(0, error.size()), error) << error_of(text);
  };
  begins("f,|Z|\n1,2\n-2,3\n", "m.csv:3:1: f: \"-2\" is no frequency");
  begins("f,|Z|\n1,2\n2,0\n", "m.csv:3:3: |Z|: \"0\" is no magnitude");
  begins("f,|Z|\n1,2\n2,NaN\n", "m.csv:3:3: |Z|: \"NaN\" is no number");
  begins("time_s,|Z|\n1,2\n", "m.csv:1:1: heading: no column is a frequency");
  begins("f,colour\n1,2\n", "m.csv:1:1: heading: no columns of an impedance");
  begins("f,|Z| (V)\n1,2\n", "m.csv:1:1: heading: \"|Z| (V)\": \"V\" is no unit");
  begins("f,impedance_magnitude_mV\n1,2\n",
         "m.csv:1:1: heading: \"impedance_magnitude_mV\": \"mV\" is no unit");
  begins("Frequency (mHz),|Z|\n1,2\n",
         "m.csv:1:1: heading: \"Frequency (mHz)\": \"mHz\" is no unit");
  begins("f_mHz,|Z|\n1,2\n", "m.csv:1:1: heading: \"f_mHz\": \"mHz\" is no unit");
  begins("f,G (MS),B (MS)\n1,2,3\n", "m.csv:1:1: heading: \"G (MS)\": \"MS\" is no unit");
  begins("f;|Z|\nkHz;furlong\n1;2\n",
         "m.csv:1:1: heading: \"|Z| [furlong]\": \"furlong\" is no unit");
  for (const char* heading : {"f,S11 (dB)", "f,S11 mag,S11 phase", "f,s_11 (dB)", "f,Gain (dB)",
                              "f,Magnitude (dB)", "f,Reflection magnitude", "f,Cp (F)"}) {
    begins(std::string(heading) + "\n1,2\n", "m.csv:1:1: heading: no columns of an impedance");
  }
  begins("\"MEASUREMENT PARAMETER: CP-D\"\n\"TRACE: A\"\n",
         "m.csv:1:25: trace: \"CP-D\" is no impedance; allowed: |Z|-theta");
  begins("f,|Z|\n1,2\n2,3\n", "m.csv:1:1: sweep: has readings at 2 frequencies");
  begins("f,|Z|\n1,2\n1,3\n", "m.csv:1:1: sweep: has readings at 1 frequency;");
  begins("# Hz S RI R 50\n1 2\n", "m.csv:2:3: touchstone: 2 numbers");
  begins("# Hz S RI R 50\n1 -1 0\n", "m.csv:2:3: touchstone: has an admittance");
  begins("[Version] 2.0\n# Hz S RI R 50\n", "m.csv:1:1: touchstone: has keywords");
  begins("\"TRACE: A\"\n\"Frequency\"\t\"x\"\n1\tx\t0\n", "m.csv:3:3: trace: \"x\" is no number");
}

/// Cut anywhere, a file is read or refused with a place.
TEST(ReadSweep, ATruncatedFileIsReadOrRefused) {
  const std::string text = file_of("f,|Z|,phase\n", [](double f, Complex z) {
    return fmt::format("{:.12g},{:.12g},{:.12g}\n", f, std::abs(z), std::arg(z) * degrees);
  });
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string error = error_of(text.substr(0, size));
    EXPECT_TRUE(error == "no error" || error.rfind("m.csv:", 0) == 0) << error;
  }
}

}  // namespace
}  // namespace sonoglide::identify::impedance
