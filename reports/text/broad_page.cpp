#include "reports/text/broad_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "reports/text/web_page.h"

namespace touchstone::reports {
namespace {

using Json = nlohmann::json;

constexpr const char* page = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Broad phase</title>
<style>
:root{color-scheme:light dark;background:var(--back);--back:#fff;--ink:#1c2733;--soft:#66727f;--line:#d9dee4;--fixed:#8a949e;--moving:#2f6fb2;--kept:#c8321f;--pruned:#b9a24a;--part:#3a9a6b}
@media screen and (prefers-color-scheme:dark){:root{--back:#14181d;--ink:#dbe2ea;--soft:#93a0ad;--line:#333c46;--fixed:#7d8893;--moving:#5c9de0;--kept:#ff6b57;--pruned:#c9b35c}}
*{box-sizing:border-box}
body{margin:0;padding:20px 24px;font:14px/1.45 system-ui,"DejaVu Sans",sans-serif;color:var(--ink)}
h1{font-size:20px;margin:0 0 2px}h2{font-size:13px;margin:14px 0 4px;font-weight:600}
p{margin:4px 0;color:var(--soft);max-width:90ch}
.bar{display:flex;flex-wrap:wrap;gap:8px 18px;align-items:center;margin:12px 0;padding:8px 12px;border:1px solid var(--line);border-radius:6px}
.bar label{display:flex;gap:6px;align-items:center}
.grid{display:grid;grid-template-columns:minmax(360px,1.25fr) minmax(320px,1fr);gap:22px}
@media(max-width:900px){.grid{grid-template-columns:1fr}}
canvas{width:100%;display:block;border:1px solid var(--line);border-radius:4px}
table{border-collapse:collapse;width:100%}td{padding:3px 0;border-bottom:1px solid var(--line)}td:last-child{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.dot{display:inline-block;width:10px;height:10px;border-radius:2px;margin-right:6px}
select,input{font:inherit}#hover{min-height:1.5em;color:var(--ink)}
</style></head><body>
<h1 id="title"></h1>
<p>A broad phase finds the pairs whose axis-aligned bounding boxes overlap without testing all pairs. Two boxes overlap
if their intervals overlap on x, y and z.</p>
<div class="bar">
<label>Method <select id="method"></select></label>
<label>Query <input id="frame" type="range" min="0" value="0"><span id="frame_name"></span></label>
<label>Across <select id="across"><option>x<option>y<option>z</select></label>
<label>Up <select id="up"><option>x<option>y<option selected>z</select></label>
<label><input type="checkbox" id="show_kept" checked>kept</label>
<label><input type="checkbox" id="show_pruned" checked>pruned</label>
<label><input type="checkbox" id="show_structure" checked>structure</label>
</div>
<div class="grid"><div>
<canvas id="plan"></canvas><p id="hover"></p>
</div><div>
<table id="counts"></table>
<h2>Intervals on x</h2><canvas class="strip" id="strip0"></canvas>
<h2>Intervals on y</h2><canvas class="strip" id="strip1"></canvas>
<h2>Intervals on z</h2><canvas class="strip" id="strip2"></canvas>
</div></div>
<p id="explanation"></p>
<script type="application/json" id="data">__TOUCHSTONE_DATA__</script>

<script type="module">
// JSON, or if it is long, {"deflate": its zlib stream in base64}.
async function pageData(){
  const value=JSON.parse(document.getElementById("data").textContent);
  if(typeof value.deflate!=="string")return value;
  const bytes=Uint8Array.from(atob(value.deflate),c=>c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).json();
}
// Boxes are stored as six differences, in steps, from the body's previous box; pairs as differences from the previous pair.
function unpack(d){
  const end=k=>k===null?null:d.origin+k*d.step,box=v=>[v.slice(0,3).map(end),v.slice(3).map(end)];
  const last=d.bodies.map(()=>[0,0,0,0,0,0]);
  const pairs=p=>{const r=[];let a=0,b=0;for(let i=0;i<p.length;i+=2){if(p[i]){a+=p[i];b=a;}b+=p[i+1];r.push([a,b]);}return r;};
  for(const f of d.frames){
    f.boxes=f.boxes.map((v,i)=>v&&box(v.map((x,k)=>x===null?null:last[i][k]+=x)));
    f.kept=pairs(f.kept);
    for(const l of f.looks){l.pruned=pairs(l.pruned);l.nodes=l.nodes.map(level=>level.map(box));}
  }
  return d;
}
const data=unpack(await pageData());
globalThis.touchstoneData=data;  // for tests and the console
const $=id=>document.getElementById(id);
const colour=name=>getComputedStyle(document.documentElement).getPropertyValue("--"+name).trim();
const C={};for(const k of["ink","soft","line","fixed","moving","kept","pruned","part"])C[k]=colour(k);
$("title").textContent="Broad phase: "+(data.name||"scene")+", "+data.bodies.length+" bodies";
for(const m of data.methods)$("method").add(new Option(m.replaceAll("_"," "),m));
$("frame").max=data.frames.length-1;
let hovered=-1;
// The picture's range over all queries: the finite ends of the moving bodies, or of all bodies if none moves.
const range=(()=>{
  for(const all of[false,true]){
    const r=[[Infinity,-Infinity],[Infinity,-Infinity],[Infinity,-Infinity]];
    for(const f of data.frames)f.boxes.forEach((b,i)=>{
      if(!b||(!all&&data.fixed[i]))return;
      for(let k=0;k<3;k++)for(const x of[b[0][k],b[1][k]])if(x!==null){r[k][0]=Math.min(r[k][0],x);r[k][1]=Math.max(r[k][1],x);}
    });
    if(r.every(a=>a[0]<=a[1]))return r.map(a=>{const m=Math.max((a[1]-a[0])*0.06,1e-9);return[a[0]-m,a[1]+m];});
  }
  return[[-1,1],[-1,1],[-1,1]];
})();
const low=(b,k)=>b[0][k]===null?-Infinity:b[0][k],high=(b,k)=>b[1][k]===null?Infinity:b[1][k];
function fit(canvas,ratio){
  const scale=window.devicePixelRatio||1,w=canvas.clientWidth,h=Math.round(w*ratio);
  canvas.style.height=h+"px";canvas.width=w*scale;canvas.height=h*scale;
  const g=canvas.getContext("2d");g.setTransform(scale,0,0,scale,0,0);g.clearRect(0,0,w,h);
  return{g,w,h};
}
const state=()=>{const f=data.frames[+$("frame").value],m=$("method").selectedIndex;return{f,look:f.looks[m]};};
let map=null;
function plan(){
  const{f,look}=state(),u=$("across").selectedIndex,v=$("up").selectedIndex;
  const{g,w,h}=fit($("plan"),0.8);
  const s=Math.min(w/(range[u][1]-range[u][0]),h/(range[v][1]-range[v][0]));
  const cu=(range[u][0]+range[u][1])/2,cv=(range[v][0]+range[v][1])/2;
  const clamp=(x,most)=>Math.max(-10,Math.min(most+10,x));
  const X=x=>clamp(w/2+(x-cu)*s,w),Y=y=>clamp(h/2-(y-cv)*s,h);
  map={X,Y,u,v};
  const rect=(b,fill,stroke,width)=>{
    const x0=X(low(b,u)),x1=X(high(b,u)),y0=Y(high(b,v)),y1=Y(low(b,v));
    if(fill){g.fillStyle=fill;g.fillRect(x0,y0,Math.max(x1-x0,1),Math.max(y1-y0,1));}
    if(stroke){g.strokeStyle=stroke;g.lineWidth=width;g.strokeRect(x0,y0,Math.max(x1-x0,1),Math.max(y1-y0,1));}
  };
  if($("show_structure").checked){
    g.lineWidth=1;
    look.grids.forEach((grid,level)=>{
      for(const k of[u,v]){
        const first=Math.max(1,Math.floor((range[k][0]-grid.origin[k])/grid.cell[k])),last=Math.min(grid.count[k]-1,Math.ceil((range[k][1]-grid.origin[k])/grid.cell[k]));
        if(last-first>400)continue;
        g.strokeStyle=k===grid.along?"#3a9a6b2a":"#3a9a6b88";g.lineWidth=1+level*0.8;
        for(let c=first;c<=last;c++){const at=grid.origin[k]+c*grid.cell[k];g.beginPath();if(k===u){g.moveTo(X(at),0);g.lineTo(X(at),h);}else{g.moveTo(0,Y(at));g.lineTo(w,Y(at));}g.stroke();}
      }
    });
  }
  const touched=new Set();for(const[a,b]of f.kept)if(a===hovered||b===hovered){touched.add(a);touched.add(b);}
  // The more boxes there are, the fainter each is drawn: otherwise many of them would form one dark area.
  const here=f.boxes.reduce((n,b)=>n+(b?1:0),0),hex=x=>Math.max(3,Math.round(x)).toString(16).padStart(2,"0"),faint=Math.min(1,120/Math.max(here,1));
  const rim=here>300?hex(255*Math.max(0.25,faint*2)):"ff";
  f.boxes.forEach((b,i)=>{if(b)rect(b,i===hovered||touched.has(i)?"#c8321f33":(data.fixed[i]?"#8a949e":"#2f6fb2")+hex(28*faint),i===hovered?C.moving:(data.fixed[i]?C.fixed:C.moving)+rim,i===hovered?2.2:1);});
  if($("show_structure").checked)look.nodes.forEach((level,l)=>{for(const b of level)rect(b,null,C.part,1.2+l);});
  // The line to a much larger box ends at its nearest point instead of its middle.
  const towards=(b,from,k)=>high(b,k)-low(b,k)>4*(high(from,k)-low(from,k))?Math.max(low(b,k),Math.min(high(b,k),mid(from,k))):mid(b,k);
  const mid=(b,k)=>{const a=low(b,k),c=high(b,k);return isFinite(a)&&isFinite(c)?(a+c)/2:isFinite(a)?a:isFinite(c)?c:(k===u?cu:cv);};
  const link=(pairs,style,width,dash)=>{
    g.strokeStyle=style;g.lineWidth=width;g.setLineDash(dash);g.beginPath();
    for(const[a,b]of pairs){
      if(hovered>=0&&a!==hovered&&b!==hovered)continue;
      const p=f.boxes[a],q=f.boxes[b];g.moveTo(X(towards(p,q,u)),Y(towards(p,q,v)));g.lineTo(X(towards(q,p,u)),Y(towards(q,p,v)));
    }
    g.stroke();g.setLineDash([]);
  };
  if($("show_pruned").checked)link(look.pruned,C.pruned+(look.pruned.length>600&&hovered<0?"28":"aa"),1,[3,3]);
  if($("show_kept").checked)link(f.kept,C.kept+(f.kept.length>600&&hovered<0?"70":"ff"),f.kept.length>600?0.8:1.6,[]);
  g.fillStyle=C.soft;g.font="12px sans-serif";g.fillText("xyz"[u]+" \u2192",w-28,h-8);g.fillText("xyz"[v]+" \u2191",8,16);
}
function strips(){
  const{f,look}=state();
  for(let k=0;k<3;k++){
    const{g,w,h}=fit($("strip"+k),0.26),span=range[k][1]-range[k][0],X=x=>Math.max(-5,Math.min(w+5,(x-range[k][0])/span*w));
    const here=f.boxes.map((b,i)=>[b,i]).filter(e=>e[0]).sort((p,q)=>low(p[0],k)-low(q[0],k));
    const grid=look.grids[0],step=(h-14)/Math.max(here.length,1);
    if(grid&&$("show_structure").checked&&span/grid.cell[k]<400){
      g.strokeStyle="#3a9a6b55";g.lineWidth=1;
      for(let c=1;c<grid.count[k];c++){const x=X(grid.origin[k]+c*grid.cell[k]);g.beginPath();g.moveTo(x,0);g.lineTo(x,h);g.stroke();}
    }
    here.forEach(([b,i],row)=>{
      g.strokeStyle=i===hovered?C.kept:data.fixed[i]?C.fixed:C.moving;g.lineWidth=Math.max(0.7,Math.min(step*0.7,5))*(i===hovered?1.5:1);
      const y=7+(row+0.5)*step;g.beginPath();g.moveTo(X(low(b,k)),y);g.lineTo(Math.max(X(high(b,k)),X(low(b,k))+1),y);g.stroke();
    });
    const title=$("strip"+k).previousElementSibling;
    title.textContent="Intervals on "+"xyz"[k]+": "+f.overlap_on_axis[k].toLocaleString("en")+" pairs overlap here"+
      (look.sweep_axis===k&&!look.grids.length?" \u2014 swept in this order":grid&&grid.along===k?" \u2014 the grid's columns run along this axis":"");
  }
}
function counts(){
  const{f,look}=state(),n=x=>x.toLocaleString("en"),times=f.kept.length?" ("+n(Math.round(f.all_pairs/f.kept.length))+"\u00d7 fewer)":"";
  const rows=[["","all pairs (exact tests without a broad phase)",n(f.all_pairs)],
    [C.part,"considered by the method",n(look.considered)],
    [C.pruned,"\u2026 of these, pruned because the boxes do not overlap",n(look.considered-Math.min(look.considered,f.kept.length))],
    [C.kept,"kept (exact tests with the broad phase)"+times,n(f.kept.length)]];
  $("counts").innerHTML="";
  for(const[c,what,count]of rows){
    const tr=$("counts").insertRow(),a=tr.insertCell(),b=tr.insertCell();
    if(c){const d=document.createElement("span");d.className="dot";d.style.background=c;a.append(d);}
    a.append(what);b.textContent=count;
  }
  $("frame_name").textContent=(+$("frame").value+1)+" of "+data.frames.length;
  $("explanation").textContent="The method's own account: "+look.explanation;
  $("hover").textContent=hovered<0?"Point at a box to see only its pairs.":data.bodies[hovered]+(data.fixed[hovered]?" (fixed)":"")+": "+
    f.kept.filter(p=>p[0]===hovered||p[1]===hovered).length+" pairs kept";
}
function draw(){plan();strips();counts();}
for(const id of["method","frame","across","up","show_kept","show_pruned","show_structure"])$(id).addEventListener("input",draw);
$("plan").addEventListener("mousemove",e=>{
  const{f}=state(),{X,Y,u,v}=map;let best=-1,size=Infinity;
  f.boxes.forEach((b,i)=>{
    if(!b)return;
    const x0=X(low(b,u)),x1=X(high(b,u)),y0=Y(high(b,v)),y1=Y(low(b,v)),area=(x1-x0)*(y1-y0);
    if(e.offsetX>=x0-2&&e.offsetX<=x1+2&&e.offsetY>=y0-2&&e.offsetY<=y1+2&&area<size){size=area;best=i;}
  });
  if(best!==hovered){hovered=best;draw();}
});
$("plan").addEventListener("mouseleave",()=>{hovered=-1;draw();});
window.addEventListener("resize",draw);
draw();
</script></body></html>
)html";

// The page stores lengths as whole steps from `origin`, finer than any screen can show. An infinite end is
// null.
struct Ruler {
  double origin = 0, step = 1;
  std::optional<std::int64_t> operator()(double x) const {
    constexpr double far = 1e15;  // steps: whole numbers that JavaScript stores exactly
    if (!std::isfinite(x)) return std::nullopt;
    return std::llround(std::clamp((x - origin) / step, -far, far));
  }
};

std::array<double, 6> ends(const Aabb& b) {
  return {b.lo.x(), b.lo.y(), b.lo.z(), b.hi.x(), b.hi.y(), b.hi.z()};
}

Ruler ruler_for(const fuzz::BroadView& view) {
  constexpr double steps = 1e5;  // over the whole scene
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const auto& f : view.frames)
    for (const auto& b : f.boxes)
      for (const double x : b ? ends(*b) : std::array<double, 6>{})
        if (b && std::isfinite(x)) {
          lo = std::min(lo, x);
          hi = std::max(hi, x);
        }
  if (!(hi > lo) || !std::isfinite(hi - lo)) return {};
  return {lo, (hi - lo) / steps};
}

// A box as differences from `last`, its ends in the previous frame.
Json packed(const Aabb& b, const Ruler& ruler, std::array<std::int64_t, 6>& last) {
  Json j = Json::array();
  const auto all = ends(b);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto x = ruler(all[k]);
    j.push_back(x ? Json(*x - last[k]) : Json());
    if (x) last[k] = *x;
  }
  return j;
}

// Sorted pairs (a, b), a < b: a as the difference from the previous a, b from the previous b or from a new a.
Json packed(const std::vector<BodyPair>& pairs) {
  Json j = Json::array();
  int last_a = 0, last_b = 0;
  for (const auto& [a, b] : pairs) {
    if (a != last_a) last_b = a;
    j.push_back(a - last_a);
    j.push_back(b - last_b);
    last_a = a;
    last_b = b;
  }
  return j;
}

Json packed_nodes(const std::vector<std::vector<Aabb>>& levels, const Ruler& ruler) {
  Json j = Json::array();
  for (const auto& level : levels) {
    Json& boxes = j.emplace_back(Json::array());
    for (const Aabb& b : level) {
      std::array<std::int64_t, 6> none{};
      boxes.push_back(packed(b, ruler, none));
    }
  }
  return j;
}

}  // namespace

std::string broad_page(const fuzz::BroadView& view) {
  const Ruler ruler = ruler_for(view);
  Json j = fuzz::to_json(view);
  j["origin"] = ruler.origin;
  j["step"] = ruler.step;
  std::vector<std::array<std::int64_t, 6>> last(view.bodies.size());
  for (std::size_t i = 0; i < view.frames.size(); ++i) {
    const auto& f = view.frames[i];
    Json& frame = j["frames"][i];
    for (std::size_t b = 0; b < f.boxes.size(); ++b)
      if (f.boxes[b]) frame["boxes"][b] = packed(*f.boxes[b], ruler, last[b]);
    frame["kept"] = packed(f.kept);
    for (std::size_t m = 0; m < f.looks.size(); ++m) {
      frame["looks"][m]["nodes"] = packed_nodes(f.looks[m].nodes, ruler);
      frame["looks"][m]["pruned"] = packed(f.looks[m].pruned);
    }
  }
  return web_page(page, j.dump());
}

}  // namespace touchstone::reports
