// An L: {0 <= x <= 6, 0 <= y <= 3} and {0 <= x <= 3, 0 <= y <= 10}, 3 m thick, of tetrahedra.
// gmsh -3 -format msh22 -setnumber size 1.5 l_block.geo -o l_block.msh
DefineConstant[size = {1.5, Name "Size of cells [m]"}];
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Point(1) = {0, 0, 0};
Point(2) = {6, 0, 0};
Point(3) = {6, 3, 0};
Point(4) = {3, 3, 0};
Point(5) = {3, 10, 0};
Point(6) = {0, 10, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
block[] = Extrude {0, 0, 3} { Surface{1}; };  // top, volume, then the sides in the order of the lines
Physical Volume("block") = {block[1]};
Physical Surface("foot") = {block[3]};
Physical Surface("head") = {block[6]};
Physical Surface("skin") = {1, block[0], block[2], block[4], block[5], block[7]};
