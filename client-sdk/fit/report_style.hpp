// The look of the report's page: light and dark, screen and paper.
#pragma once

namespace mechane::fit {

inline constexpr const char* kReportStyle = R"css(
:root{--paper:#faf8f3;--card:#fffefb;--ink:#262320;--soft:#6d675f;--line:#ddd7ca;--accent:#8a4b2a;--plate:#f1ede3}
@media (prefers-color-scheme:dark){:root{--paper:#191816;--card:#211f1d;--ink:#ece7dd;--soft:#a49c90;--line:#3a3632;
--accent:#dfa071;--plate:#2a2825}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.55 system-ui,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
main{max-width:1140px;margin:0 auto;padding:48px 28px 72px}
h1,h2{font-family:"Iowan Old Style","Palatino Linotype",Palatino,"Book Antiqua",Georgia,"DejaVu Serif",serif;font-weight:600}
h1{font-size:42px;line-height:1.12;margin:4px 0 14px;overflow-wrap:anywhere}
h2{font-size:25px;margin:60px 0 6px}
.kicker{color:var(--accent);font-size:13px;letter-spacing:.14em;text-transform:uppercase}
.verdict{font-size:20px;line-height:1.45;max-width:44em;margin:0}
.lead{color:var(--soft);max-width:50em;margin:0 0 18px}
dl.key{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:1px;margin:30px 0 0;background:var(--line);
border:1px solid var(--line)}
dl.key div{background:var(--card);padding:14px 16px}
dl.key dt{font-size:13px;color:var(--soft)}
dl.key dd{margin:0;font-size:24px;font-variant-numeric:tabular-nums;white-space:nowrap}
code{white-space:nowrap;font-size:.92em}
figure{margin:0}
.row{display:flex;justify-content:space-around;align-items:flex-end;gap:12px;background:var(--plate);padding:22px 14px 10px}
.row figure{flex:0 1 auto;min-width:0;text-align:center}
.row img{max-width:100%;height:auto;display:block;margin:0 auto}
figcaption{font-size:13px;color:var(--soft);margin-top:6px}
.legend{display:flex;flex-wrap:wrap;gap:4px 18px;margin:12px 0 0;padding:0;list-style:none;font-size:14px}
.dot{display:inline-block;width:11px;height:11px;border-radius:2px;margin-right:6px;vertical-align:-1px;
box-shadow:0 0 0 1px rgba(128,128,128,.35)}
.bar{display:flex;align-items:center;gap:10px;font-size:14px;margin-top:12px;font-variant-numeric:tabular-nums;flex-wrap:wrap}
.bar i{display:block;height:12px;width:300px;max-width:40vw;box-shadow:0 0 0 1px rgba(128,128,128,.35)}
.maps{display:grid;grid-template-columns:repeat(auto-fill,minmax(205px,1fr));gap:14px}
.maps.few{grid-template-columns:repeat(auto-fill,minmax(340px,1fr))}
.maps figure{background:var(--card);border:1px solid var(--line);padding:12px}
.maps img{width:100%;height:auto;display:block;image-rendering:pixelated}
.maps b{display:block;font-weight:600;font-size:14px;overflow:hidden;text-overflow:ellipsis;white-space:nowrap;margin-bottom:8px}
.maps .bar{gap:6px;font-size:12px;color:var(--soft);margin-top:8px;flex-wrap:nowrap}
.maps .bar i{height:8px;width:auto;flex:1}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:13.5px;font-variant-numeric:tabular-nums}
th{font-weight:500;color:var(--soft);text-align:right;vertical-align:bottom;padding:6px 6px;border-bottom:1px solid var(--ink);
white-space:nowrap;line-height:1.3}
td{text-align:right;padding:5px 6px;border-bottom:1px solid var(--line);white-space:nowrap}
th:first-child,td:first-child{text-align:left;padding-left:0}
td:first-child{max-width:260px;overflow:hidden;text-overflow:ellipsis}
.plain th,.plain td{text-align:left;padding-left:0;white-space:normal;border-bottom:1px solid var(--line)}
.plain td{overflow-wrap:anywhere}
.worst td{font-weight:600}
ul.notes{border-left:3px solid var(--accent);margin:26px 0 0;padding:2px 0 2px 22px}
ul.notes li{margin:6px 0;padding:0}
.two{columns:2 380px;column-gap:40px}
.two p{margin:0 0 12px;break-inside:avoid}
footer{margin-top:56px;color:var(--soft);font-size:13px;border-top:1px solid var(--line);padding-top:14px;overflow-wrap:anywhere}
@media print{h2{break-after:avoid}figure,tr{break-inside:avoid}}
)css";

}  // namespace mechane::fit
