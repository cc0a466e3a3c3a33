#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "layout/layout_report.h"

/// A sample report of an evaluation, and requirements on pages.

namespace tera {

inline PolarMap SampleMap(double value = 0.25) {
  PolarMap map{.id = {Measure::kSeenMap, "0.9"},
               .title = "seen 0.9 m above the ground",
               .sectors = 72,
               .rings = 24,
               .ring_m = 1};
  map.value.assign(72 * 24, value);
  return map;
}

/// Numbers in kQuarters.
inline constexpr std::size_t kLeft = 1, kBehind = 2;

inline LayoutReport SampleReport(const std::string& name = "front") {
  LayoutReport report;
  report.name = name;
  report.file = "rigs/" + name + ".yaml";
  report.cycle = "out/base";
  report.asked_sha256 = "0123456789abcdef";
  report.viewers = {"lidar", "camera"};
  report.expense = {4500, 8.5, 33.25, 3, 2, 1};
  report.t_s = {0, 0.2, 0.4, 0.6};
  report.figures = {
      {{Measure::kSeenBy1, "around"}, {0.5, 0.75, 0.25, 0.5}, {0.01, 0.02, 0.03, 0.02}},
      {{Measure::kBlindVolume, "around"}, {30, 15, 45, 30}, {1, 2, 3, 2}},
      {{Measure::kDetectedFrom, "standing", kBehind}, {1, 2, 2, 3}, {}},
      {{Measure::kDetectedTo, "standing", kBehind}, {4, 4, 5, 7}, {}},
      {{Measure::kDetectedOver, "standing", kBehind}, {4, 3, 4, 5}, {}},
      {{Measure::kDetectedShare, "standing"}, {0.25, 0.5, 0.25, 0.5}, {}},
      {{Measure::kEdgeSeen, "bucket"}, {0, 1, 0.125, 0.375}, {}}};
  report.maps = {SampleMap()};
  report.curves = {{{Measure::kPersonCurve, "standing"},
                    "a standing person",
                    24,
                    {1, 2, 3},
                    {0.5, 1, 2},
                    {0, 0.5, 1}}};
  report.blind_causes = {{"around", {{"arm", 0.75}, {"out of view", 0.25}}}, {"behind", {}}};
  report.overlaps = {{"around", {{"lidar + camera", 0.125}}}};
  report.warnings = {"lidar is mounted inside of boom, 0.1 m deep"};
  return report;
}

/// A name that resembles HTML markup, and its escaped form.
inline constexpr char kMarkup[] = "a<b>&\"c\"";
inline constexpr char kEscapedMarkup[] = "a&lt;b&gt;&amp;&quot;c&quot;";

/// Every open tag is closed in order, with its quotes; an ampersand only begins entities. HTML's
/// void elements need no end.
inline void ExpectWellFormed(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < html.size(); ++i) {
    if (html[i] == '&') {
      const std::size_t end = html.find(';', i);
      ASSERT_NE(end, html.npos);
      ASSERT_LE(end - i, 7u) << html.substr(i, 30);
    }
    ASSERT_NE(html[i], '>') << "closes nothing: " << html.substr(i > 40 ? i - 40 : 0, 60);
    if (html[i] != '<') continue;
    std::string tag;
    bool quoted = false;
    for (++i; i < html.size() && (quoted || html[i] != '>'); ++i) {
      if (html[i] == '"') quoted = !quoted;
      ASSERT_FALSE(html[i] == '<') << "opens within a tag: " << tag;
      tag += html[i];
    }
    ASSERT_LT(i, html.size()) << "never ends: " << tag.substr(0, 60);
    if (tag.starts_with("!") || tag.ends_with("/")) continue;
    const std::string name = tag.substr(0, tag.find_first_of(" \n"));
    if (name == "meta" || name == "br" || name == "hr" || name == "img") continue;
    if (name.starts_with("/")) {
      ASSERT_FALSE(open.empty()) << tag;
      ASSERT_EQ("/" + open.back(), name);
      open.pop_back();
      continue;
    }
    ASSERT_TRUE(!name.empty() && std::isalpha(static_cast<unsigned char>(name[0]))) << tag;
    open.push_back(name);
    if (name == "style" || name == "script") i = html.find("</" + name, i) - 1;
  }
  EXPECT_TRUE(open.empty()) << open.back();
}

/// Nothing is fetched, neither from a network nor from files next to the page.
inline void ExpectSelfContained(const std::string& html) {
  for (const char* link : {"http:", "https:", "src=", "href=", "url(", "@import", "<link"}) {
    EXPECT_EQ(html.find(link), html.npos) << link;
  }
}

}  // namespace tera
