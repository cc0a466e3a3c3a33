#include "diagnose/report/page/page.h"

#include <fmt/format.h>

namespace tera {
namespace {

/// The style sheet of a report.
constexpr std::string_view kPageStyle = R"(
:root{color-scheme:light dark;--paper:#fdfdfc;--ink:#1d232b;--soft:#5a6470;--rule:#d9dde2;
--fill:#f3f5f7;--measured:#2b323b;--before:#c8551b;--after:#1769aa;--shade:#f6ecc9;--visits:#b9c1ca;
--wrong:#fdf0e8}
@media(prefers-color-scheme:dark){:root{--paper:#15191e;--ink:#e4e8ec;--soft:#9aa5b1;--rule:#333b45;
--fill:#1d232a;--measured:#d5dbe2;--before:#f0894d;--after:#62b0f0;--shade:#3a351f;--visits:#4a5460;
--wrong:#33241b}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);line-height:1.5;
font-family:system-ui,"Segoe UI",Roboto,"Helvetica Neue","DejaVu Sans",sans-serif;font-size:16px}
main{max-width:64rem;margin:0 auto;padding:2.2rem 1.4rem 4rem}
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .3rem}
h2{font-size:1.25rem;margin:2.8rem 0 .6rem;padding-top:1rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:1.6rem 0 .3rem}
p{margin:.5rem 0}.soft{color:var(--soft)}
code{font-family:ui-monospace,Menlo,Consolas,"DejaVu Sans Mono",monospace;font-size:.86em}
.answer{font-size:1.25rem;font-weight:600;margin:1rem 0 .6rem}
.first{border:2px dashed var(--before);border-radius:.5rem;padding:.6rem .8rem;margin:.8rem 0}
.sign{display:inline-block;min-width:1.35em;height:1.35em;line-height:1.35em;border-radius:50%;
text-align:center;font-size:.85rem;font-weight:700;margin-right:.3em}
b.wrong{background:var(--before);color:var(--paper)}b.open{border:1.5px dashed var(--before)}
b.fine{color:var(--after)}b.idle{color:var(--soft)}
.chainkey{font-size:.86rem;color:var(--soft)}.chainkey span{display:inline-block;margin-right:1.1em}
.chain{display:flex;flex-wrap:wrap;gap:.9rem;list-style:none;padding:0;margin:1rem 0 .6rem}
.chain li{flex:1 1 8.5rem;position:relative;border:1px solid var(--rule);border-radius:.5rem;padding:.5rem .7rem}
.chain li+li::before{content:"\2192";position:absolute;left:-.95rem;top:.5rem;color:var(--soft)}
.chain p{margin:.3rem 0 0;font-size:.86rem;overflow-wrap:anywhere}.chain li.fine{border-color:var(--soft)}
.chain li.idle{background:var(--fill)}.chain li.wrong{background:var(--wrong);border:2.5px solid var(--before)}
.chain li.open{border:2px dashed var(--before)}.chain b.sign{border-width:1.5px}
.cause{margin:1.6rem 0 0}.cause h2{margin:0 0 .3rem}.plain{font-size:1.1rem;margin:.2rem 0 .5rem}
.told{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,1fr);gap:1.6rem;align-items:start}
.told div:only-child{grid-column:1/-1}.told figure{margin:.3rem 0}.told p{overflow-wrap:anywhere}
.told path.measured{stroke-width:5;stroke-opacity:.3}
@media(max-width:46rem){.told{grid-template-columns:minmax(0,1fr);gap:.4rem}.told svg text{font-size:16px}}
.part>summary{font-size:1.05rem;font-weight:600;color:var(--ink);padding:.35rem 0}
ol.findings{padding-left:1.3rem;margin:.8rem 0}ol.findings li{margin:.55rem 0;padding-left:.2rem}
figure{margin:.6rem 0 1.2rem}figcaption{font-size:.86rem;color:var(--soft);margin:.1rem 0 0 .2rem}
.pair figure:only-child{grid-column:1/-1;max-width:31rem}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:1.6rem;align-items:start}
@media(max-width:46rem){.pair figure:only-child{grid-column:1/-1;max-width:31rem}
.pair{grid-template-columns:1fr}}
:not(svg)>svg{display:block;width:100%;height:auto;overflow:visible}svg svg{overflow:hidden}
svg text{font-size:13px;fill:var(--soft)}svg text.axis{fill:var(--ink)}
svg text.number{font-variant-numeric:tabular-nums}
.grid{stroke:var(--rule);fill:none}.tick,.frame{stroke:var(--soft);fill:none}
.zero{stroke:var(--soft);stroke-dasharray:3 4;fill:none}
.line{fill:none;stroke-width:1.7;stroke-linejoin:round}.thin{fill:none;stroke-width:.9}
path.measured{stroke:var(--measured);stroke-opacity:.55}path.before{stroke:var(--before)}
path.after{stroke:var(--after)}.shade{fill:var(--shade)}
.band{fill:var(--before);fill-opacity:.2}.visits{fill:var(--visits)}.dot{fill:var(--before)}
.key{display:inline-block;width:1.5em;height:.26em;margin:0 .45em .2em 0;vertical-align:middle}
.entry{margin-right:1.1em;white-space:nowrap}.key.measured{background:var(--measured);opacity:.55}
.key.before{background:var(--before)}.key.after{background:var(--after)}
.key.shaded,.key.band,.key.visited,.key.higher,.key.lower{height:.75em;width:1.1em}
.key.shaded{background:var(--shade)}.key.band{background:var(--before);opacity:.3}
.key.visited{background:var(--visits)}
.level{fill:var(--fill)}.higher{fill:var(--before)}.lower{fill:var(--after)}
.key.higher{background:var(--before)}.key.lower{background:var(--after)}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.92rem;margin:.4rem 0 1rem;font-variant-numeric:tabular-nums}
th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1.5px solid var(--rule)}
th,td{padding:.28rem 1.5rem .28rem 0;vertical-align:baseline}td{border-bottom:1px solid var(--rule)}
.r{text-align:right}summary{cursor:pointer;color:var(--soft);margin:.6rem 0}
@media print{main{max-width:none;padding:0}figure,table{break-inside:avoid}}
)";

}  // namespace

std::string Page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<meta name='viewport' "
      "content='width=device-width, initial-scale=1'>\n<title>{}</title>\n<style>{}</style>\n"
      "</head>\n<body><main>\n{}</main></body>\n</html>\n",
      Escaped(title), kPageStyle, body);
}

Table::Table(const std::vector<std::string>& headings) {
  html_ = "<div class='wide'><table><tr>";
  for (const std::string& heading : headings) {
    const bool is_number = heading.starts_with('>');
    classes_.push_back(is_number ? " class='r'" : "");
    html_ += fmt::format("<th{}>{}</th>", classes_.back(), heading.substr(is_number ? 1 : 0));
  }
  html_ += "</tr>\n";
}

void Table::Row(const std::vector<std::string>& cells) {
  html_ += "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i) {
    html_ += fmt::format("<td{}>{}</td>", classes_[i], cells[i]);
  }
  html_ += "</tr>\n";
  has_rows_ = true;
}

std::string Code(std::string_view text) { return "<code>" + Escaped(text) + "</code>"; }

}  // namespace tera
