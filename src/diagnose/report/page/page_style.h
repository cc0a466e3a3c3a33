#pragma once

#include <string_view>

namespace tera {

/// The style sheet of the report.
inline constexpr std::string_view kPageStyle = R"(
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
.chainbox{margin:1rem 0 1.4rem}.chainkey{font-size:.86rem;color:var(--soft)}
.chainkey span{display:inline-block;margin-right:1.1em}
:not(svg)>svg.chain{height:var(--h1)}.chain .title{font-size:15px;font-weight:600;fill:var(--ink)}
.chain .mark{font-weight:700;fill:var(--before)}.chain .arrow{stroke:var(--soft);fill:none}
.box{fill:none;stroke:var(--rule)}.box.fine{stroke:var(--soft)}.box.idle{fill:var(--fill)}
.box.wrong{fill:var(--wrong);stroke:var(--before);stroke-width:2.5}
.box.open{stroke:var(--before);stroke-width:2;stroke-dasharray:6 4}
circle.wrong{fill:var(--before)}circle.open{fill:none;stroke:var(--before);stroke-dasharray:3 2}
svg text.sign{font-size:14px;font-weight:700;fill:var(--ink)}svg text.sign.wrong{fill:var(--paper)}
path.fine{stroke:var(--after);stroke-width:2.4;fill:none}path.idle{stroke:var(--soft);stroke-width:2}
@media(max-width:64rem){:not(svg)>svg.chain{height:var(--h2)}.chain .s0{transform:translate(13px,0)}
.chain .s1{transform:translate(171px,0)}.chain .s2{transform:translate(329px,0)}
.chain .s3{transform:translate(13px,var(--row))}.chain .s4{transform:translate(171px,var(--row))}
.chain .s5{transform:translate(329px,var(--row))}}
@media(max-width:33rem){main{padding:1.4rem 1.4rem 3rem}:not(svg)>svg.chain{height:var(--h3)}
.chain .s2{transform:translate(13px,var(--row))}.chain .s3{transform:translate(171px,var(--row))}
.chain .s4{transform:translate(13px,var(--row2))}.chain .s5{transform:translate(171px,var(--row2))}}
.cause{margin:1.6rem 0 0}.cause h2{margin:0 0 .3rem}.plain{font-size:1.1rem;margin:.2rem 0 .5rem}
.told{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,1fr);gap:1.6rem;align-items:start}
.told dl:only-child{grid-column:1/-1}.told figure{margin:.3rem 0}
.told path.measured{stroke-width:5;stroke-opacity:.3}
dl{margin:0}dt{font-weight:600;font-size:.9rem;color:var(--soft)}dd{margin:0 0 .7rem;overflow-wrap:anywhere}
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
.bar{fill:var(--visits)}.bar.first{fill:var(--before)}.bar.chosen{fill:var(--after)}.bar.flexible{fill:none;stroke:var(--soft)}
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
