/* occt_read.cc - what Open CASCADE makes of an IGES file: "faces N", and the area of each in mm2. */
#include <cstdio>

#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>

static const double accuracy = 1e-7;

int main(int argc, char **argv)
{
	IGESControl_Reader reader;
	int n = 0;
	if (argc != 2)
		return 2;
	Message::DefaultMessenger()->ChangePrinters().Clear();
	if (reader.ReadFile(argv[1]) != IFSelect_RetDone)
		return 1;
	reader.TransferRoots();
	const TopoDS_Shape shape = reader.OneShape();
	if (shape.IsNull())
		return 1;
	for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next())
		n++;
	printf("faces %d\n", n);
	for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
		GProp_GProps p;
		BRepGProp::SurfaceProperties(e.Current(), p, accuracy);
		printf("%.17g\n", p.Mass());
	}
	return 0;
}
