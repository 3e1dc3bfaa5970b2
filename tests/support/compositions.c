/* SPDX-License-Identifier: MIT */
#include "compositions.h"

#define CAMERA "'camera':{'position':[1.4,1.1,2.6],'fov':36},"
#define INSIDE "'camera':{'position':[0.2,0.1,0.3],'target':[-0.4,-0.1,-1],'fov':80},"
#define SPHERE(r, x, y, z)                                                                         \
    "{'type':'sphere','params':{'radius':" #r "},'transform':{'translation':[" #x "," #y "," #z    \
    "]}}"
#define BOX(a, b, c, x, y, z)                                                                      \
    "{'type':'box','params':{'size':[" #a "," #b "," #c "]},'transform':{'translation':[" #x       \
    "," #y "," #z "],'rotation':[0.3,0.4,0.1]}}"
#define BLEND(type, kernel, k)                                                                     \
    "{'type':'" type "','params':{'kernel':'" kernel "','k':" k                                    \
    "},'children':[" BOX(0.7, 0.7, 0.7, 0, 0, 0) "," SPHERE(0.4, 0.3, 0.35, 0.2) "]}"
/* Every kernel. */
#define BLENDS(word, type)                                                                         \
    {.name = "quadratic " word, CAMERA, BLEND(type, "quadratic", "0.2")},                          \
        {.name = "cubic " word, CAMERA, BLEND(type, "cubic", "0.2")},                              \
        {.name = "quartic " word, CAMERA, BLEND(type, "quartic", "0.2")},                          \
        {.name = "circular " word, CAMERA, BLEND(type, "circular", "0.2")},                        \
        {.name = "exponential " word, CAMERA, BLEND(type, "exponential", "24")},                   \
        {.name = "root " word, CAMERA, BLEND(type, "root", "0.01")},                               \
        {.name = "power " word, CAMERA, BLEND(type, "power", "8")},                                \
    {                                                                                              \
        .name = "polynomial " word, CAMERA, BLEND(type, "polynomial", "0.2,'order':5")             \
    }
#define TURNED "'transform':{'rotation':[0.4,0.5,0.2]}"

const struct composition compositions[] = {
    {.name = "quartic torus",
     CAMERA,
     "{'type':'field','params':{'lipschitz':18,'size':[2,2,2],'code':'float sdf(vec3 "
     "p){float q=dot(p,p)+0.32;return q*q-1.44*dot(p.xz,p.xz);}'}," TURNED "}",
     .alone = true},
    {.name = "sheet of a gyroid",
     CAMERA,
     "{'type':'gyroid','params':{'period':0.7,'thickness':0.004,'size':[1,1,1]}," TURNED "}"},
    {.name = "slab", CAMERA, "{'type':'box','params':{'size':[1.4,0.002,1]}," TURNED "}"},
    {.name = "edge-on slab",
     "'camera':{'position':[3,0.04,0.6],'fov':36},",
     "{'type':'box','params':{'size':[1.4,0.003,1]}}"},
    {.name = "cut eggshell",
     CAMERA,
     "{'type':'difference','children':[{'type':'shell','params':{'thickness':0.002},"
     "'children':[" SPHERE(0.6, 0, 0, 0) "]}," BOX(0.9, 0.9, 0.9, 0.4, 0.4, 0.3) "]}"},
    {.name = "shells in shells",
     CAMERA,
     "{'type':'difference','children':[{'type':'shell','params':{'thickness':0.02},"
     "'children':[{'type':'shell','params':{'thickness':0.08},'children':["
     "{'type':'torus'," TURNED "}]}]}," BOX(1, 1, 1, 0.4, 0.4, 0.3) "]}"},
    {.name = "exclusive of five",
     CAMERA,
     "{'type':'exclusive','children':[" SPHERE(0.4, 0, 0.25, 0) "," SPHERE(
         0.4, 0.25, 0, 0.1) "," SPHERE(0.4, -0.25, 0, 0) "," SPHERE(0.4, 0, -0.25,
                                                                    0.2) "," BOX(0.5, 0.5, 0.5, 0,
                                                                                 0, 0.2) "]}"},
    {.name = "overlapping repeat",
     CAMERA,
     "{'type':'repeat','params':{'spacing':[0.3,0.35,0.4],'count':[3,2,2]},'children':"
     "[" BOX(0.5, 0.3, 0.3, 0.1, 0.05, 0) "," SPHERE(0.22, 0, 0.1, 0.1) "]}"},
    {.name = "overlapping polar repeat",
     CAMERA,
     "{'type':'repeat_polar','params':{'count':9,'radius':0.45},'children':[" BOX(
         0.5, 0.3, 0.5, 0.1, 0.05, 0) "]," TURNED "}"},
    {.name = "endless repeat",
     CAMERA,
     "{'type':'intersection','children':[" SPHERE(
         0.7, 0, 0, 0) ","
                       "{'type':'repeat','params':{'spacing':[0.2,0.2,0.2],'count':[-1,-1,-1]},"
                       "'children':[" SPHERE(0.115, 0, 0, 0) "]}]}"},
    {.name = "tiny things repeated",
     CAMERA,
     "{'type':'repeat','params':{'spacing':[0.2,0.2,0.2],'count':[6,5,5]},'children':"
     "[" SPHERE(0.05, 0, 0, 0) "," BOX(0.04, 0.04, 0.04, 0.06, 0.05, 0) "]}"},
    {.name = "wires",
     CAMERA,
     "{'type':'repeat','params':{'spacing':[0.16,1,0.16],'count':[6,0,6]},'children':["
     "{'type':'cylinder','params':{'radius':0.012,'height':1}}]," TURNED "}"},
    {.name = "turned star",
     CAMERA,
     "{'type':'revolve','params':{'offset':0.45},'children':[{'type':'star',"
     "'params':{'radius':0.3}}]," TURNED "}"},
    {.name = "turned profile over the axis",
     CAMERA,
     "{'type':'revolve','params':{'offset':0.1},'children':[{'type':'polygon',"
     "'params':{'points':[[0,-0.6],[0.5,-0.5],[0.2,-0.1],[0.45,0.2],[0.1,0.6],[-0.2,0.3]]}}],"
     "'transform':{'rotation':[0.4,0,0.2]}}"},
    {.name = "turned cross",
     CAMERA,
     "{'type':'revolve','params':{'offset':0.4},'children':[{'type':'cross',"
     "'params':{'size':0.5,'thickness':0.12},'transform':{'rotation':[0,0,0.4]}}]," TURNED "}"},
    {.name = "deep menger",
     CAMERA,
     "{'type':'menger','params':{'size':1,'iterations':3}," TURNED "}",
     .alone = true},
    {.name = "sheared",
     CAMERA,
     "{'type':'group','transform':{'scale':[1.2,0.35,0.8]},'children':["
     "{'type':'torus','transform':{'rotation':[0.6,0.7,0.8]}}," BOX(0.5, 0.9, 0.3, 0.2, 0.1,
                                                                    0.3) "]}"},
    {.name = "pancake",
     CAMERA,
     "{'type':'sphere','transform':{'scale':[0.8,0.03,0.5],'rotation':[0.3,0.2,0.5]}}"},
    {.name = "screw",
     CAMERA,
     "{'type':'twist','params':{'rate':4},'children':[" BOX(0.5, 1.2, 0.3, 0, 0, 0) "]}"},
    {.name = "bow",
     CAMERA,
     "{'type':'bend','params':{'rate':1.2},'children':[" BOX(1.3, 0.2, 0.4, 0, 0, 0) "]}"},
    {.name = "golf ball",
     CAMERA,
     "{'type':'displace','params':{'amplitude':0.05,'frequency':[14,14,14]},'children':"
     "[" SPHERE(0.6, 0, 0, 0) "]}"},
    {.name = "waves",
     CAMERA,
     "{'type':'offset_space','params':{'amplitude':[0.08,0.05,0.06],'frequency':[6,7,5]},"
     "'children':[" BOX(0.8, 0.8, 0.6, 0, 0, 0) "]}"},
    {.name = "drilled block",
     CAMERA,
     "{'type':'difference','children':[" BOX(
         1, 0.8, 0.9, 0, 0, 0) ",{'type':'repeat',"
                               "'params':{'spacing':[0.22,1,0.22],'count':[4,0,4]},"
                               "'children':[{'type':'cylinder',"
                               "'params':{'radius':0.08,'height':3}}]}," SPHERE(0.3, 0.4, 0.4,
                                                                                0.4) "]}"},
    {.name = "lens",
     CAMERA,
     "{'type':'intersection','children':[" SPHERE(1, 0, 0, 0.9) "," SPHERE(1, 0, 0, -0.9) "]}"},
    {.name = "round frame",
     CAMERA,
     "{'type':'round','params':{'radius':0.05},'children':[{'type':'box_frame',"
     "'params':{'size':[1,0.8,0.7],'thickness':0.05}," TURNED "}]}"},
    {.name = "halves",
     CAMERA,
     "{'type':'mirror','params':{'axes':[true,false,false]},'children':[" BOX(
         0.5, 0.5, 0.5, 0.3, 0.1, 0) "," SPHERE(0.3, 0.1, 0.4, 0.2) "]}"},
    {.name = "long ring",
     CAMERA,
     "{'type':'elongate','params':{'size':[0.2,0.05,0.1]},'children':["
     "{'type':'torus','params':{'radius':0.3,'tube':0.1}," TURNED "}]}"},
    {.name = "morph",
     CAMERA,
     "{'type':'morph','params':{'t':0.4},'children':[" BOX(0.8, 0.8, 0.8, 0, 0,
                                                           0) "," SPHERE(0.6, 0, 0, 0) "]}"},
    {.name = "models",
     CAMERA "'models':{'m':{'type':'smooth_union','params':{'k':0.1},'children':"
            "[" SPHERE(0.2, 0, 0.2, 0) ",{'type':'cone','params':{'radius':0.2,'height':0.5}}]}},",
     "{'type':'group','children':[{'type':'model','params':{'model':'m'}},"
     "{'type':'model','params':{'model':'m'},'transform':{'translation':[0.5,0,0],"
     "'scale':[0.5,1.2,0.7],'rotation':[0.4,0.1,0.6]}},{'type':'model','params':{"
     "'model':'m'},'transform':{'translation':[-0.5,0.1,0.2],'scale':1.3}}]}"},
    {.name = "own waves",
     CAMERA,
     "{'type':'field','params':{'lipschitz':2.2,'code':'float sdf(vec3 p){return "
     "length(p)-0.5+0.05*sin(20.*p.x)*sin(20.*p.y)*sin(20.*p.z);}'}}",
     .alone = true},
    {.name = "own surface, steep",
     CAMERA,
     "{'type':'field','params':{'lipschitz':60,'size':[1.4,1.4,1.4],'code':'float "
     "sdf(vec3 p){vec3 q=3.*p;return q.x*q.x*q.x*q.x-3.*q.x*q.x+q.y*q.y*q.y*q.y-3.*q.y*q.y"
     "+q.z*q.z*q.z*q.z-3.*q.z*q.z+5.;}'}," TURNED "}",
     .alone = true},
    {.name = "two leaves on a huge ball",
     CAMERA,
     "{'type':'group','children':[" SPHERE(1000, 0, -1000.4, 0) "," SPHERE(
         0.4, 0, 0, 0) ",{'type':'box','params':{'size':[0.4,0.4,0.4]},'transform':{"
                       "'translation':[0.5,-0.2,0.4]}}]}"},
    {.name = "box on a plane",
     CAMERA,
     "{'type':'group','children':[{'type':'plane','params':{'offset':-0.3}},"
     "{'type':'box','params':{'size':[0.6,0.6,0.6]}},{'type':'box','params':{"
     "'size':[0.01,0.5,0.5]},'transform':{'translation':[0.6,-0.05,0.4]}}]}"},
    {.name = "inside a shell",
     INSIDE,
     "{'type':'group','children':[{'type':'shell','params':{'thickness':0.05},"
     "'children':[" SPHERE(1.3, 0, 0, 0) "]}," BOX(0.4, 0.4, 0.4, -0.3, -0.2, -0.6) "]}",
     .inside = true},
    {.name = "inside a room",
     INSIDE,
     "{'type':'difference','children':[{'type':'box','params':{'size':[3,3,3]}}," BOX(
         2, 1.6, 2.4, 0, 0, 0) "," SPHERE(0.7, -0.6, 0.2, -1.2) "]}",
     .inside = true},
    BLENDS("union", "smooth_union"),
    BLENDS("intersection", "smooth_intersection"),
    BLENDS("difference", "smooth_difference"),
    {.name = "torus of that quartic",
     CAMERA,
     "{'type':'torus','params':{'radius':0.6,'tube':0.2}," TURNED "}",
     .alone = true},
};
const size_t composition_count = sizeof compositions / sizeof compositions[0];
