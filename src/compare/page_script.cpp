// Buttons, inputs and boxes are made by the script, so that a page without it has nothing that does nothing.
#include "compare/page_script.h"

#include "std.h"

namespace carom {

const string_view comparison_style = R"(.answers td{vertical-align:top;text-align:left}
.answers b{font-size:1.13em}
.answers b.p{font-size:inherit}
.answers{min-width:100%}
.answers td small{display:block;overflow-wrap:anywhere}
.rank td:first-child{color:#5b6675}
.rank td{white-space:nowrap}
.row{display:flex;flex-wrap:wrap;gap:14px 28px;align-items:flex-start}
.row>figure{flex:1 1 440px;min-width:0;max-width:660px}
.row>div{max-width:100%}
.pair{display:flex;flex-wrap:wrap;gap:0 28px}
.pair>div{max-width:100%}
.heat table{table-layout:fixed;width:100%;border-collapse:separate;border-spacing:1px}
.heat th{padding:0 5px;border:0;background:none;font-weight:400;font-size:12px;text-align:center}
.heat th:first-child{width:62px;text-align:right}
.heat td{padding:0;border:0;text-align:center}
.heat td a{display:block;min-height:22px;line-height:22px;font-size:12px;color:inherit}
.heat .fine td a{min-height:16px;line-height:16px}
.heat .wide{padding-right:6px}
.heat .fine th:not(:first-child){padding:0;vertical-align:bottom}
.heat .fine span{writing-mode:vertical-rl;transform:rotate(180deg);white-space:nowrap;line-height:1}
.scale{font-size:13px;margin:4px 0 0}
.scale span{display:inline-flex;vertical-align:-2px;margin:0 4px}
.scale i{width:6px;height:13px}
.bars table{width:100%}
.bar{width:45%;min-width:70px}
.bar i{display:block;height:15px;background:#0072b2}
#table{overflow:auto;max-height:88vh;border:1px solid #d8dde4;border-radius:6px}
#runs{font-size:13px;min-width:100%;border-collapse:separate;border-spacing:0}
#runs thead{position:sticky;top:0;z-index:2}
#runs thead th{vertical-align:bottom}
#runs th button{all:unset;cursor:pointer;font-weight:600}
#runs th button:focus-visible{outline:2px solid #0b5cad}
#runs th[aria-sort=ascending] button::after{content:" \25B2"}
#runs th[aria-sort=descending] button::after{content:" \25BC"}
#runs th.v{background:#e8f0f8}
#runs td{vertical-align:middle}
#runs td:first-child{white-space:nowrap}
#runs tr:hover td{background:#f3f7fb}
#runs tr{scroll-margin-top:90px}
#runs tr:target td,#runs tr.on td{background:#ddebfa}
#runs tr.doubtful td{background:#fff7df}
#runs tr.failed td{background:#fdece8}
#runs .m{text-align:left;padding:3px 6px}
#runs .m img,#runs .m video{display:block;width:160px;min-height:40px;height:auto}
#runs input[type=search]{width:100%;min-width:56px;font:inherit;font-weight:400;padding:2px 4px;border:1px solid #b9c4d0;border-radius:4px}
#runs input[aria-invalid=true]{border-color:#b3261e;background:#fdece8}
#runs input[type=checkbox]{margin:0 6px 0 0;vertical-align:-1px}
#side{position:fixed;left:0;right:0;bottom:0;z-index:5;max-height:62vh;overflow:auto;background:#fff;border-top:2px solid #0b5cad;
box-shadow:0 -4px 18px #0003;padding:8px clamp(12px,2.5vw,40px)}
#side .bar1{display:flex;gap:10px;align-items:center;position:sticky;left:0;margin-bottom:6px;flex-wrap:wrap}
#side input{flex:1;max-width:420px;min-width:80px}
#side th{background:#fff}
#side thead td{text-align:left;vertical-align:bottom}
#side video,#side img{display:block;width:min(340px,78vw);height:auto}
#side td{text-align:left}
button.act{font:inherit;padding:3px 12px;border:1px solid #0b5cad;border-radius:6px;background:#fff;color:#0b5cad;cursor:pointer}
@media(max-width:700px){.heat .fine td a,.heat tr:has(td:nth-child(8)) td a{font-size:0}}
@media print{.row>figure{flex-basis:45%;max-width:48%}.heat .fine td a{min-height:11px;line-height:11px}
#table{max-height:none;overflow:visible;border:0}#runs{font-size:7.5pt}#runs thead{position:static}
#runs th,#runs td{padding:1px 4px}#runs .m img{width:90px}#side,#runs video,#runs input,.tools{display:none!important}}
)";

const string_view comparison_script = R"(<script>//<![CDATA[
(() => {
'use strict';
const table = document.getElementById('runs');
if (!table) return;
const body = table.tBodies[0], head = table.tHead.rows[0], heads = [...head.cells], rows = [...body.rows];
const make = (name, more) => Object.assign(document.createElement(name), more);
const text = (row, k) => row.cells[k].textContent.trim();
const value = (row, k) => {
  if (!heads[k].classList.contains('n')) return text(row, k);
  const all = row.cells[k].dataset.v ?? text(row, k);
  return all === '' ? NaN : Number(all);
};

// Sorting: a click on a head. Empty cells come last, equal ones stay in the order of the runs.
const sort = k => {
  const was = heads[k].getAttribute('aria-sort'), up = was === null ? true : was === 'ascending' ? false : null;
  heads.forEach(h => h.removeAttribute('aria-sort'));
  if (up !== null) heads[k].setAttribute('aria-sort', up ? 'ascending' : 'descending');
  const keys = new Map(rows.map(row => [row, value(row, k)])), sign = up ? 1 : -1;
  const empty = key => key === '' || key !== key;
  const compare = (a, b) => {
    const x = keys.get(a), y = keys.get(b);
    if (empty(x) || empty(y)) return empty(x) - empty(y);
    return sign * (typeof x === 'number' ? x - y : x.localeCompare(y, 'en', {numeric: true}));
  };
  body.append(...(up === null ? rows : [...rows].sort(compare)));
};

// Filters: an input below each head. Numbers: > 3, <= 5, 2..4. Texts: a part of them.
const test = (input, k) => {
  const words = input.value.trim().toLowerCase();
  input.removeAttribute('aria-invalid');
  if (words === '') return null;
  if (!heads[k].classList.contains('n')) return row => text(row, k).toLowerCase().includes(words);
  const range = words.match(/^(\S+)\s*\.\.\s*(\S+)$/), one = words.match(/^(<=|>=|<|>|=)?\s*(\S+)$/);
  const from = Number(range ? range[1] : one && one[2]), to = range ? Number(range[2]) : from;
  if (!(range || one) || from !== from || to !== to) {
    input.setAttribute('aria-invalid', 'true');
    return null;
  }
  if (range) return row => value(row, k) >= from && value(row, k) <= to;
  const by = {'<': v => v < from, '<=': v => v <= from, '>': v => v > from, '>=': v => v >= from, '=': v => v === from};
  return row => by[one[1] || '='](value(row, k));
};
const shown = document.getElementById('shown'), all = shown.textContent, inputs = [];
const filter = () => {
  const tests = inputs.map(([input, k]) => test(input, k)).filter(Boolean);
  let count = 0;
  for (const row of rows) {
    row.hidden = !tests.every(accepts => accepts(row));
    count += !row.hidden;
  }
  shown.textContent = tests.length ? `${count} of ${rows.length} runs` : all;
};
const line = table.tHead.insertRow();
heads.forEach((th, k) => {
  const cell = line.appendChild(make('th'));
  if (th.classList.contains('m')) return;
  const button = make('button', {type: 'button', textContent: th.textContent, onclick: () => sort(k)});
  th.replaceChildren(button);
  const number = th.classList.contains('n');
  const input = make('input', {type: 'search', placeholder: number ? '> 3, 2..4' : 'text', oninput: filter});
  input.setAttribute('aria-label', 'filter ' + button.textContent);
  cell.append(input);
  inputs.push([input, k]);
});
// A link to a row shows it even if a filter hides it.
const arrive = () => {
  const row = document.getElementById(location.hash.slice(1));
  if (!row || !rows.includes(row)) return;
  row.hidden = false;
  row.scrollIntoView({block: 'center'});
};
addEventListener('hashchange', arrive);

// Side by side: films have one clock.
const most = 6, side = make('section', {id: 'side', hidden: true}), chosen = [];
side.setAttribute('aria-label', 'Side by side');
document.body.append(side);
const films = () => [...side.querySelectorAll('video')];
const longest = () => films().reduce((a, b) => (b.duration || 0) > (a.duration || 0) ? b : a, films()[0]);
const play = make('button', {className: 'act', type: 'button'}), clear = make('button', {className: 'act', type: 'button', textContent: 'Close'});
const at = make('input', {type: 'range', min: 0, max: 1, step: 0.001, value: 0});
at.setAttribute('aria-label', 'time in the films');
const name = () => { play.textContent = films().some(film => !film.paused && !film.ended) ? 'Pause' : 'Play all'; };
play.onclick = () => {
  if (films().some(film => !film.paused && !film.ended)) return films().forEach(film => film.pause());
  const start = longest().ended ? 0 : longest().currentTime;
  for (const film of films()) {
    film.currentTime = Math.min(start, film.duration || 0);
    film.play().catch(() => {});
  }
};
at.oninput = () => films().forEach(film => {
  film.pause();
  film.currentTime = Math.min(at.value * (longest().duration || 0), film.duration || 0);
});
const media = row => {
  const cell = row.querySelector('.m'), link = cell && cell.querySelector('a'), video = cell && cell.querySelector('video');
  const image = cell && cell.querySelector('img');
  const film = video ? video.getAttribute('src') : link && /\.mp4$/i.test(link.getAttribute('href')) ? link.getAttribute('href') : null;
  if (film) {
    const shows = make('video', {muted: true, playsInline: true, preload: 'metadata', src: film, controls: true});
    for (const event of ['play', 'pause', 'ended']) shows.addEventListener(event, name);
    shows.addEventListener('timeupdate', () => { if (shows === longest()) at.value = shows.currentTime / (shows.duration || 1); });
    return shows;
  }
  return image ? make('img', {src: link.getAttribute('href'), alt: ''}) : '';
};
const draw = () => {
  side.hidden = chosen.length === 0;
  document.body.style.paddingBottom = side.hidden ? '' : '64vh';
  const grid = make('table'), top = grid.createTHead().insertRow(), names = grid.createTBody();
  top.append(make('th'));
  for (const row of chosen) top.insertCell().append(make('b', {textContent: text(row, 0)}), media(row));
  heads.forEach((th, k) => {
    if (k === 0 || th.classList.contains('m')) return;
    const line = names.insertRow();
    line.append(make('th', {textContent: th.textContent}));
    for (const row of chosen) line.insertCell().textContent = text(row, k);
  });
  const tools = make('div', {className: 'bar1'});
  tools.append(make('b', {textContent: 'Side by side'}), clear);
  side.replaceChildren(tools, grid);
  if (films().length) tools.append(play, at);
  name();
};
const choose = (row, on) => {
  const at = chosen.indexOf(row);
  if (on === (at >= 0)) return;
  if (on) chosen.push(row); else chosen.splice(at, 1);
  if (chosen.length > most) mark(chosen.shift(), false);
  mark(row, on);
  draw();
};
const mark = (row, on) => {
  row.querySelector('input').checked = on;
  row.classList.toggle('on', on);
};
clear.onclick = () => {
  chosen.splice(0).forEach(row => mark(row, false));
  draw();
};
for (const row of rows) {
  const box = make('input', {type: 'checkbox', onchange: () => choose(row, box.checked)});
  box.setAttribute('aria-label', 'side by side: ' + text(row, 0));
  row.cells[0].prepend(box);
  const link = row.querySelector('.m a');
  if (link) link.onclick = event => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    choose(row, true);
  };
}
document.querySelectorAll('.tools').forEach(one => { one.hidden = false; });

// The first picture of a film is loaded when its row comes into view.
const near = new IntersectionObserver(seen => seen.forEach(one => {
  if (!one.isIntersecting) return;
  one.target.preload = 'metadata';
  near.unobserve(one.target);
}));
table.querySelectorAll('video').forEach(film => near.observe(film));
arrive();
})();
//]]></script>
)";

}  // namespace carom
