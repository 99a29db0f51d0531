# Writes a mesh in the format of Gmsh (2.2) for gmshToFoam. Variables: kind, n (cells along a side), irregular (0 or 1: nodes
# inside are moved).
#   box    triangles in a rectangle of width x height, m across;      patches left right bottom top, frontAndBack
#   beam   the same, m across a thickness of 1, n = 8 m along 8;     patches left above below free, frontAndBack: above is the
#          upper side from 6 to 7, below the lower one from 7 to 8
#   tri    triangles in the unit square, one layer of thickness 0.1;  patches low high front back, frontAndBack
#   ring   triangles in a quarter of the ring from radius 1 to 2;     patches inner outer low left, frontAndBack
#   prism  the triangles of tri in n layers of thickness 1/n;         patches low high front back bottom top
#   tet    tetrahedra in the unit cube;                               the same patches
function moved(i, most, seed,   s) { s = sin(12.9898*(seed + 1))*43758.5453; s -= int(s); return i > 0 && i < most ? (kind == "tet" ? 0.2 : 0.35)*irregular*s : 0 }
function group(name, dim) { if (!(name in number)) { number[name] = ++groups; dims[groups] = dim; title[groups] = name } return number[name] }
function element(type, name, dim, nodes) { line[++elements] = type " 2 " group(name, dim) " " group(name, dim) " " nodes }
function node(i, j, k) { return 1 + i + (n + 1)*(j + (m + 1)*k) }
function side(a, b, k, name) { element(3, name, 2, a + plane*k " " b + plane*k " " b + plane*(k + 1) " " a + plane*(k + 1)) }
function layers(   i, j, k, q, a, b, c, t, s) { # triangles, and prisms between them
    for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
        q[0] = node(i, j, 0); q[1] = node(i + 1, j, 0); q[2] = node(i + 1, j + 1, 0); q[3] = node(i, j + 1, 0)
        s = (i + j) % 2
        for (t = 0; t < 2; t++) {
            a = s ? q[0] : (t ? q[1] : q[0]); b = s ? (t ? q[2] : q[1]) : (t ? q[2] : q[1]); c = s ? (t ? q[3] : q[2]) : q[3]
            for (k = 0; k < depth; k++)
                element(6, "cells", 3, a + plane*k " " b + plane*k " " c + plane*k " " a + plane*(k + 1) " " b + plane*(k + 1) " " c + plane*(k + 1))
            element(2, kind == "prism" ? "bottom" : "frontAndBack", 2, a " " b " " c)
            element(2, kind == "prism" ? "top" : "frontAndBack", 2, a + plane*depth " " b + plane*depth " " c + plane*depth)
        }
    }
    for (k = 0; k < depth; k++) {
        for (i = 0; i < n; i++) {
            side(node(i, 0, 0), node(i + 1, 0, 0), k, kind == "beam" && i >= 7*m ? "below" : sides[1])
            side(node(i, m, 0), node(i + 1, m, 0), k, kind == "beam" && i >= 6*m && i < 7*m ? "above" : sides[2])
        }
        for (j = 0; j < m; j++) {
            side(node(0, j, 0), node(0, j + 1, 0), k, sides[3])
            side(node(n, j, 0), node(n, j + 1, 0), k, sides[4])
        }
    }
}
function tetrahedra(   i, j, k, p, d, v, x, s, o, f, axis, all, value, c, odd) { # six in each cube, along its diagonal
    split("012 021 102 120 201 210", order, " ")
    for (k = 0; k < n; k++) for (j = 0; j < n; j++) for (i = 0; i < n; i++) for (p = 1; p <= 6; p++) {
        x[0, 0] = i; x[0, 1] = j; x[0, 2] = k
        for (s = 1; s <= 3; s++) {
            for (d = 0; d < 3; d++) x[s, d] = x[s - 1, d]
            x[s, substr(order[p], s, 1) + 0]++
        }
        for (s = 0; s <= 3; s++) v[s] = node(x[s, 0], x[s, 1], x[s, 2])
        # Odd orders of the axes turn the tetrahedron inside out
        odd = order[p] ~ /021|102|210/
        element(4, "cells", 3, v[0] " " v[1] " " v[2 + odd] " " v[3 - odd])
        for (o = 0; o <= 3; o++) for (axis = 0; axis < 3; axis++) for (c = 0; c < 2; c++) {
            all = 1; f = ""; value = c*n
            for (s = 0; s <= 3; s++) if (s != o) { f = f " " v[s]; if (x[s, axis] != value) all = 0 }
            if (all) element(2, name[axis, c], 2, f)
        }
    }
}
BEGIN {
    pi = atan2(0, -1)
    if (kind == "beam") { n = 8*m; width = 8; height = 1 }
    else if (kind != "box") { m = kind == "ring" ? int(1.5*n) : n; width = height = 1 }
    split(kind == "ring" ? "low left inner outer" : kind == "box" ? "bottom top left right" : kind == "beam" ? "free free left free" : "front back low high", sides, " ")
    depth = kind == "prism" || kind == "tet" ? n : 1
    plane = (n + 1)*(m + 1)
    name[0, 0] = "low"; name[0, 1] = "high"; name[1, 0] = "front"; name[1, 1] = "back"; name[2, 0] = "bottom"; name[2, 1] = "top"
    kind == "tet" ? tetrahedra() : layers()
    print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" groups
    for (g = 1; g <= groups; g++) print dims[g], g, "\"" title[g] "\""
    print "$EndPhysicalNames\n$Nodes\n" plane*(depth + 1)
    for (k = 0; k <= depth; k++) for (j = 0; j <= m; j++) for (i = 0; i <= n; i++) {
        seed = i + 31*j + (depth == n && kind == "tet" ? 1009*k : 0)
        x = width*(i + (kind == "beam" && i % m == 0 ? 0 : moved(i, n, seed)))/n; y = height*(j + moved(j, m, seed + 7))/m
        z = kind == "tet" ? (k + moved(k, n, seed + 13))/n : kind == "prism" ? k/n : 0.1*k
        if (kind == "ring") {
            r = 1 + x; t = 0.5*pi*y
            x = j == m ? 0 : r*cos(t); y = j == 0 ? 0 : r*sin(t)
        }
        printf "%d %.17g %.17g %.17g\n", node(i, j, k), x, y, z
    }
    print "$EndNodes\n$Elements\n" elements
    for (e = 1; e <= elements; e++) print e, line[e]
    print "$EndElements"
}
