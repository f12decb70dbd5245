// One column at 400 pixels, two at 1,600. Tables scroll by themselves, the page never scrolls sideways.
#include "export/page_style.h"

#include "std.h"

namespace carom {

const string_view page_style = R"(
*{box-sizing:border-box}
body{margin:0 auto;max-width:1640px;padding:16px clamp(12px,2.5vw,40px) 60px;color:#1c2430;background:#fff;
font:15px/1.45 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif}
h1{font-size:1.7em;line-height:1.2;margin:0 0 6px;overflow-wrap:anywhere}
h2{font-size:1.27em;margin:26px 0 8px;padding-top:8px;border-top:1px solid #d8dde4}
h3{font-size:1em;margin:14px 0 6px}
p{margin:6px 0;max-width:100ch}
a{color:#0b5cad;text-decoration:none}
a:hover{text-decoration:underline}
code,pre{font:13px/1.4 ui-monospace,"DejaVu Sans Mono",Menlo,Consolas,monospace}
pre{overflow:auto;padding:10px;background:#f5f7f9;border-radius:6px}
small,.quiet{color:#5b6675;font-size:.87em}
.links a{display:inline-block;margin:4px 8px 4px 0;padding:3px 10px;border:1px solid #b9c4d0;border-radius:6px}
.flag{display:inline-block;padding:1px 8px;border-radius:9px;background:#e8eef5;margin-right:6px}
.doubtful{background:#fff1c9}
.failed{background:#fbdcd6}
.good{background:#dff1e0}
.wide{overflow-x:auto;max-width:100%}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:3px 10px;text-align:right;border-bottom:1px solid #e6eaee;vertical-align:baseline}
th{text-align:left;font-weight:600;background:#f5f7f9}
td.t,th.t{text-align:left}
th.n{text-align:right}
td.k{text-align:left;white-space:nowrap}
td.t{overflow-wrap:break-word;max-width:60ch}
.columns{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr));gap:14px 28px;align-items:start}
.columns>*{min-width:0}
.columns>div>h2:first-child,.columns>div>h3:first-child{margin-top:0}
details{margin:8px 0}
summary{cursor:pointer;color:#0b5cad}
figure{margin:0 0 12px;max-width:660px;break-inside:avoid}
figcaption{font-weight:600;margin-bottom:2px}
figcaption small{font-weight:400;display:block}
.chart{display:block;width:100%;height:auto;font-family:system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
.key{font-size:.87em;margin:0;display:flex;flex-wrap:wrap;gap:2px 14px}
.key svg{width:26px;height:14px;vertical-align:-3px;margin-right:4px}
.marks{position:absolute;width:0;height:0}
.film{display:block;width:100%;max-width:960px;height:auto;background:#f5f7f9;border-radius:6px}
@media(max-width:600px){body{font-size:14px}th,td{padding:3px 7px}}
@page{size:A4 landscape;margin:10mm}
@media print{*{-webkit-print-color-adjust:exact;print-color-adjust:exact}
body{max-width:none;padding:0;font-size:9pt}a{color:inherit}.wide{overflow:visible}.links{display:none}
.columns{grid-template-columns:1fr 1fr}h2{margin-top:8px}h2,h3{break-after:avoid}tr,figure,.key{break-inside:avoid}}
)";

}  // namespace carom
