#pragma once

#include <string_view>

namespace tera {

/// The style sheet of the report.
inline constexpr std::string_view kPageStyle = R"(
:root{color-scheme:light dark;--paper:#fdfdfc;--ink:#1d232b;--soft:#5a6470;--rule:#d9dde2;
--fill:#f3f5f7;--measured:#2b323b;--before:#c8551b;--after:#1769aa;--shade:#f6ecc9;--visits:#b9c1ca}
@media(prefers-color-scheme:dark){:root{--paper:#15191e;--ink:#e4e8ec;--soft:#9aa5b1;--rule:#333b45;
--fill:#1d232a;--measured:#d5dbe2;--before:#f0894d;--after:#62b0f0;--shade:#3a351f;--visits:#4a5460}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);line-height:1.5;
font-family:system-ui,"Segoe UI",Roboto,"Helvetica Neue","DejaVu Sans",sans-serif;font-size:16px}
main{max-width:64rem;margin:0 auto;padding:2.2rem 1.4rem 4rem}
h1{font-size:1.7rem;line-height:1.2;margin:0 0 .3rem}
h2{font-size:1.25rem;margin:2.8rem 0 .6rem;padding-top:1rem;border-top:1px solid var(--rule)}
h3{font-size:1rem;margin:1.6rem 0 .3rem}
p{margin:.5rem 0}.soft{color:var(--soft)}
code{font-family:ui-monospace,Menlo,Consolas,"DejaVu Sans Mono",monospace;font-size:.86em}
.verdict{display:inline-block;margin:.9rem .5rem .2rem 0;padding:.15rem .7rem;border-radius:1rem;
font-weight:600;font-size:.9rem;border:1.5px solid currentColor}
.named{color:var(--after)}.class,.unexplained{color:var(--before)}.none,.untestable{color:var(--soft)}
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
.bar{fill:var(--visits)}.bar.chosen{fill:var(--after)}.bar.flexible{fill:none;stroke:var(--soft)}
.key{display:inline-block;width:1.5em;height:.26em;margin:0 .45em .2em 0;vertical-align:middle}
.entry{margin-right:1.1em;white-space:nowrap}.key.measured{background:var(--measured);opacity:.55}
.key.before{background:var(--before)}.key.after{background:var(--after)}
.key.shaded,.key.band,.key.visited,.key.chosen,.key.flexible{height:.75em;width:1.1em}
.key.shaded{background:var(--shade)}.key.band{background:var(--before);opacity:.3}
.key.visited{background:var(--visits)}.key.chosen{background:var(--after)}
.key.flexible{border:1px solid var(--soft)}
.level{fill:var(--fill)}.higher{fill:var(--before)}.lower{fill:var(--after)}
.key.higher{background:var(--before);height:.75em;width:1.1em}
.key.lower{background:var(--after);height:.75em;width:1.1em}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.92rem;margin:.4rem 0 1rem;font-variant-numeric:tabular-nums}
th{text-align:left;font-weight:600;color:var(--soft);border-bottom:1.5px solid var(--rule)}
th,td{padding:.28rem 1.5rem .28rem 0;vertical-align:baseline}td{border-bottom:1px solid var(--rule)}
.r{text-align:right}summary{cursor:pointer;color:var(--soft);margin:.6rem 0}
@media print{main{max-width:none;padding:0}figure,table{break-inside:avoid}}
)";

}  // namespace tera
