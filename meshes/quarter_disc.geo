// A quarter of a disc of radius 1 about the origin, of triangles.
// gmsh -2 -format msh22 -setnumber size 0.05 quarter_disc.geo -o quarter_disc.msh
DefineConstant[size = {0.05, Name "Size of cells"}];
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {0, 1, 0};
Line(1) = {1, 2};
Circle(2) = {2, 1, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Physical Surface("gas") = {1};
Physical Curve("y-") = {1};
Physical Curve("outside") = {2};
Physical Curve("x-") = {3};
