// A wall bracket, in millimetres: two plates at a right angle, rounded in the inner corner, with a
// gusset, two screw holes in the wall plate, and two small and one large hole in the shelf plate.
// gmsh -3 -format msh2 bracket.geo
SetFactory("OpenCASCADE");

width = 60;  depth = 80;  height = 70;  thick = 6;  round = 10;

Box(1) = {0, 0, 0, width, thick, height};  // against the wall, y = 0
Box(2) = {0, 0, 0, width, depth, thick};   // the shelf, z = 0
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

// The inner corner: what a square rod leaves of itself outside a round one.
Box(4) = {0, thick, thick, width, round, round};
Cylinder(5) = {-1, thick + round, thick + round, width + 2, 0, 0, round};
BooleanDifference(6) = { Volume{4}; Delete; }{ Volume{5}; Delete; };

// The gusset: a triangle in the middle, 6 mm wide.
Point(101) = {27, thick, thick};  Point(102) = {27, 50, thick};  Point(103) = {27, thick, 46};
Line(201) = {101, 102};  Line(202) = {102, 103};  Line(203) = {103, 101};
Curve Loop(301) = {201, 202, 203};
Plane Surface(301) = {301};
gusset[] = Extrude {6, 0, 0} { Surface{301}; };
BooleanUnion(20) = { Volume{3}; Delete; }{ Volume{6, gusset[1]}; Delete; };

Cylinder(31) = {13, -1, 52, 0, thick + 2, 0, 4};
Cylinder(32) = {47, -1, 52, 0, thick + 2, 0, 4};
Cylinder(33) = {12, 34, -1, 0, 0, thick + 2, 4};
Cylinder(34) = {48, 34, -1, 0, 0, thick + 2, 4};
Cylinder(35) = {30, 64, -1, 0, 0, thick + 2, 10};
BooleanDifference(40) = { Volume{20}; Delete; }{ Volume{31, 32, 33, 34, 35}; Delete; };

Mesh.CharacteristicLengthMin = 1.2;
Mesh.CharacteristicLengthMax = 1.72;
Mesh.CharacteristicLengthFromCurvature = 1;
Mesh.MinimumCirclePoints = 24;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
