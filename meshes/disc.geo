// A disc of radius 1, its centre at (0, 1): half of it, right of its axis, of triangles.
// gmsh -2 -format msh22 -setnumber size 0.1 disc.geo -o disc.msh
DefineConstant[size = {0.1, Name "Size of cells"}];
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Point(1) = {0, 1, 0};
Point(2) = {0, 0, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 2, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 1};
Line(4) = {1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("drop") = {1};
Physical Curve("skin") = {1, 2};
Physical Curve("axis") = {3, 4};
