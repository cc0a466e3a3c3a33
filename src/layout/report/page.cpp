#include "layout/report/page.h"

#include <fmt/format.h>

#include "layout/report/polar_drawing.h"
#include "layout/report/words.h"

namespace tera {
namespace {

constexpr const char* kStyle = R"(
:root{color-scheme:light dark;--paper:#fdfdfc;--ink:#1d232b;--soft:#5a6470;--rule:#d9dde2;
--a:#1769aa;--b:#c8551b;--c:#5b8c2a;--d:#7a4fa3;--e:#9a7400}
@media(prefers-color-scheme:dark){:root{--paper:#15191e;--ink:#e4e8ec;--soft:#9aa5b1;--rule:#333b45;
--a:#62b0f0;--b:#f0894d;--c:#9bcb62;--d:#b793dd;--e:#d8b54a}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);line-height:1.5;
font-family:system-ui,"Segoe UI",Roboto,"Helvetica Neue","DejaVu Sans",sans-serif;font-size:16px}
main{max-width:70rem;margin:0 auto;padding:2rem 1.4rem 4rem}
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .3rem}
h2{font-size:1.25rem;margin:2.6rem 0 .6rem;padding-top:1rem;border-top:1px solid var(--rule)}
p{margin:.5rem 0}.soft{color:var(--soft)}.answer{font-size:1.1rem;margin:.25rem 0}
.answer:first-of-type{font-size:1.3rem;font-weight:600}
.warning{border-left:4px solid var(--b);padding:.2rem .8rem;margin:.6rem 0}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(17rem,1fr));gap:1.4rem}
figure{margin:0}figcaption{font-size:.88rem;color:var(--soft)}
svg{display:block;width:100%;height:auto;max-width:28rem}
svg text{font-size:12px;fill:var(--ink);paint-order:stroke;stroke:var(--paper);stroke-width:3.5px;
stroke-linejoin:round}svg text.direction{font-weight:600}
path[stroke]{stroke-width:.7}.machine,.rim{fill:none;stroke-width:1.8}
.rim{stroke:#111;stroke-width:3}.machine{stroke:#fff;stroke-dasharray:6 3}.grid{fill:none;stroke:var(--ink);stroke-opacity:.25}
.outline{fill:none;stroke-width:2.2}.area{fill-opacity:.22}
.outline.a{stroke:var(--a)}.area.a{fill:var(--a)}.outline.b{stroke:var(--b)}.area.b{fill:var(--b)}
.outline.c{stroke:var(--c)}.area.c{fill:var(--c)}.outline.d{stroke:var(--d)}.area.d{fill:var(--d)}
.outline.e{stroke:var(--e)}.area.e{fill:var(--e)}
.key{display:inline-block;width:1.1em;height:.8em;margin:0 .4em 0 .8em}
.key.a{background:var(--a)}.key.b{background:var(--b)}.key.c{background:var(--c)}
.key.d{background:var(--d)}.key.e{background:var(--e)}
.scale{display:inline-block;width:9em;height:.8em;vertical-align:middle;margin:0 .5em}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.92rem;margin:.4rem 0 1rem;font-variant-numeric:tabular-nums}
th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1.5px solid var(--rule)}
th,td{padding:.26rem 1.4rem .26rem 0;vertical-align:baseline}td{border-bottom:1px solid var(--rule)}
td.r,th.r{text-align:right}tr.better td:last-child{color:var(--a)}tr.worse td:last-child{color:var(--b)}
@media print{main{max-width:none;padding:0}figure,table{break-inside:avoid}}
)";

}  // namespace

std::string PageBegin(const std::string& title) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>{}</title>\n<style>{}</style></head>\n<body><main>\n",
      Escaped(title), kStyle);
}

std::string PageEnd() { return "</main></body></html>\n"; }

std::string MapLegend() {
  std::string stops;
  constexpr int kStops = 4;
  for (int i = 0; i <= kStops; ++i) {
    const auto rgb = ColourOf(static_cast<double>(i) / kStops);
    stops += fmt::format(",rgb({} {} {})", rgb[0], rgb[1], rgb[2]);
  }
  return fmt::format(
      "<p class=\"soft\">never seen<span class=\"scale\" "
      "style=\"background:linear-gradient(90deg{})\"></span>always seen; grey: inside a solid body "
      "or outside the site; dashed: outline of the machine from above, without its arm</p>\n",
      stops);
}

}  // namespace tera
