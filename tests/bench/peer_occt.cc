/* peer_occt.cc - Open CASCADE. */
#include "peer.h"

#include <cmath>
#include <vector>

#include <Adaptor3d_TopolTool.hxx>
#include <Contap_Contour.hxx>
#include <Contap_Line.hxx>
#include <GeomAPI_IntSS.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_OffsetSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <Standard_Version.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>

static const double resolution = 1e-9;

/* A surface and the sum of what was found on it last. */
struct occt {
	Handle(Geom_BSplineSurface) s;
	double sum;
};

/* Knots each once, with their multiplicities. */
static void split_knots(const double *k, int n, std::vector<double> &once, std::vector<int> &times)
{
	for (int i = 0; i < n; i++)
		if (once.empty() || k[i] != once.back()) {
			once.push_back(k[i]);
			times.push_back(1);
		} else {
			times.back()++;
		}
}

static void *surface(const struct peer_net *x)
{
	TColgp_Array2OfPnt p(1, x->n[0], 1, x->n[1]);
	TColStd_Array2OfReal w(1, x->n[0], 1, x->n[1]);
	std::vector<double> once[2];
	std::vector<int> times[2];
	for (int i = 0; i < x->n[0]; i++)
		for (int j = 0; j < x->n[1]; j++) {
			const double *c = x->points + 4 * (i * x->n[1] + j);
			p(i + 1, j + 1) = gp_Pnt(c[0] / c[3], c[1] / c[3], c[2] / c[3]);
			w(i + 1, j + 1) = c[3];
		}
	for (int d = 0; d < 2; d++)
		split_knots(x->knots[d], x->n[d] + x->order[d], once[d], times[d]);
	const TColStd_Array1OfReal u(once[0][0], 1, (int)once[0].size());
	const TColStd_Array1OfReal v(once[1][0], 1, (int)once[1].size());
	const TColStd_Array1OfInteger mu(times[0][0], 1, (int)times[0].size());
	const TColStd_Array1OfInteger mv(times[1][0], 1, (int)times[1].size());
	occt *out = new occt();
	if (x->rational)
		out->s = new Geom_BSplineSurface(p, w, u, v, mu, mv, x->order[0] - 1,
		                                 x->order[1] - 1);
	else
		out->s = new Geom_BSplineSurface(p, u, v, mu, mv, x->order[0] - 1, x->order[1] - 1);
	return out;
}

static void drop(void *data)
{
	delete static_cast<occt *>(data);
}

static void grid_curvatures(void *data, const double *x, int n)
{
	GeomLProp_SLProps at(static_cast<occt *>(data)->s, 2, resolution);
	double sum = 0, others = 0;
	for (int i = 0; i < n; i++)
		for (int j = 0; j < n; j++) {
			at.SetParameters(x[i], x[j]);
			if (!at.IsCurvatureDefined())
				continue;
			sum += at.GaussianCurvature();
			others += at.MeanCurvature() + at.MaxCurvature() + at.MinCurvature();
		}
	static_cast<occt *>(data)->sum = others == others ? sum : 0;
}

/* The adaptor keeps the span it was in last. */
static void grid_points(void *data, const double *x, int n)
{
	GeomAdaptor_Surface at(static_cast<occt *>(data)->s);
	gp_Pnt p;
	double sum = 0;
	for (int i = 0; i < n; i++)
		for (int j = 0; j < n; j++) {
			at.D0(x[i], x[j], p);
			sum += p.X() + p.Y() + p.Z();
		}
	static_cast<occt *>(data)->sum = sum;
}

static double grid_sum(void *data)
{
	return static_cast<occt *>(data)->sum;
}

static double points(void *data, const double *uv, int n)
{
	const Handle(Geom_BSplineSurface) &s = static_cast<occt *>(data)->s;
	gp_Pnt p;
	double sum = 0;
	for (int i = 0; i < n; i++) {
		s->D0(uv[2 * i], uv[2 * i + 1], p);
		sum += p.X() + p.Y() + p.Z();
	}
	return sum;
}

static double curvatures(void *data, const double *uv, int n)
{
	GeomLProp_SLProps at(static_cast<occt *>(data)->s, 2, resolution);
	double sum = 0, others = 0;
	for (int i = 0; i < n; i++) {
		at.SetParameters(uv[2 * i], uv[2 * i + 1]);
		if (!at.IsCurvatureDefined())
			continue;
		sum += at.GaussianCurvature();
		others += at.MeanCurvature() + at.MaxCurvature() + at.MinCurvature();
	}
	return others == others ? sum : 0;
}

static bool curvature(void *data, double u, double v, double kh[2], double point[3])
{
	GeomLProp_SLProps at(static_cast<occt *>(data)->s, u, v, 2, resolution);
	if (!at.IsCurvatureDefined())
		return false;
	kh[0] = at.GaussianCurvature();
	kh[1] = at.MeanCurvature();
	for (int c = 0; c < 3; c++)
		point[c] = at.Value().Coord(c + 1);
	return true;
}

static int interpolate_curve(const double *xyz, int n)
{
	Handle(TColgp_HArray1OfPnt) p = new TColgp_HArray1OfPnt(1, n);
	for (int i = 0; i < n; i++)
		p->SetValue(i + 1, gp_Pnt(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]));
	GeomAPI_Interpolate x(p, Standard_False, resolution);
	x.Perform();
	return x.IsDone() ? x.Curve()->NbPoles() : 0;
}

static int interpolate_surface(const double *xyz, int n)
{
	TColgp_Array2OfPnt p(1, n, 1, n);
	for (int j = 0; j < n; j++)
		for (int i = 0; i < n; i++, xyz += 3)
			p(i + 1, j + 1) = gp_Pnt(xyz[0], xyz[1], xyz[2]);
	GeomAPI_PointsToBSplineSurface x;
	x.Interpolate(p);
	return x.IsDone() ? x.Surface()->NbUPoles() * x.Surface()->NbVPoles() : 0;
}

/* The lowest degree that it reaches a tolerance of 1e-3 with on a surface of 7 x 7 spans. */
enum { OFFSET_DEGREE = 8, OFFSET_SPANS = 1000 };

static void *offset(void *data, double distance, double tolerance)
{
	Handle(Geom_OffsetSurface) exact =
	        new Geom_OffsetSurface(static_cast<occt *>(data)->s, distance);
	GeomConvert_ApproxSurface x(exact, tolerance, GeomAbs_C1, GeomAbs_C1, OFFSET_DEGREE,
	                            OFFSET_DEGREE, OFFSET_SPANS, 0);
	if (!x.HasResult())
		return nullptr;
	occt *out = new occt();
	out->s = x.Surface();
	return out;
}

static void poles(void *data, int n[2])
{
	n[0] = static_cast<occt *>(data)->s->NbUPoles();
	n[1] = static_cast<occt *>(data)->s->NbVPoles();
}

static void place_at(const gp_Pnt &p, peer_place *place, void *data)
{
	const double xyz[3] = { p.X(), p.Y(), p.Z() };
	place(xyz, data);
}

static int cut_curves(const occt *x, const peer_field *f, peer_place *place, void *data)
{
	const gp_Dir d(f->direction[0], f->direction[1], f->direction[2]);
	const gp_Pnt p(f->point[0], f->point[1], f->point[2]);
	Handle(Geom_Surface) by;
	if (f->kind == PEER_PLANE)
		by = new Geom_Plane(gp_Pnt(d.XYZ() * f->value), d);
	else
		by = new Geom_CylindricalSurface(gp_Ax3(p, d), f->value);
	GeomAPI_IntSS found(x->s, by, f->tolerance);
	const int n = found.IsDone() ? found.NbLines() : 0;
	for (int i = 1; place && i <= n; i++) {
		const Handle(Geom_Curve) &c = found.Line(i);
		const double from = c->FirstParameter(), to = c->LastParameter();
		for (int k = 0; k < PEER_PLACES; k++)
			place_at(c->Value(from + (to - from) * (k + 0.5) / PEER_PLACES), place, data);
	}
	return n;
}

/* Broken lines. */
static int outline_curves(const occt *x, const peer_field *f, peer_place *place, void *data)
{
	const gp_Vec d(f->direction[0], f->direction[1], f->direction[2]);
	const Handle(GeomAdaptor_Surface) s = new GeomAdaptor_Surface(x->s);
	const Handle(Adaptor3d_TopolTool) domain = new Adaptor3d_TopolTool(s);
	Contap_Contour found;
	if (f->kind == PEER_SILHOUETTE)
		found.Perform(s, domain, d);
	else if (f->kind == PEER_EYE)
		found.Perform(s, domain, gp_Pnt(f->point[0], f->point[1], f->point[2]));
	else
		found.Perform(s, domain, -d, std::asin(f->value)); /* N . -d = -sin(angle) */
	const int n = found.IsDone() ? found.NbLines() : 0;
	for (int i = 1; place && i <= n; i++) {
		const Contap_Line &line = found.Line(i);
		const int points = line.TypeContour() == Contap_Walking ? line.NbPnts() : 0;
		for (int k = 1; k < points; k++) {
			const gp_XYZ a = line.Point(k).Value().XYZ(), b = line.Point(k + 1).Value().XYZ();
			place_at(gp_Pnt(a), place, data);
			place_at(gp_Pnt((a + b) / 2), place, data);
		}
	}
	return n;
}

static int curves(void *data, const peer_field *f, peer_place *place, void *place_data)
{
	const occt *x = static_cast<occt *>(data);
	try {
		return f->kind == PEER_PLANE || f->kind == PEER_CYLINDER
		               ? cut_curves(x, f, place, place_data)
		               : outline_curves(x, f, place, place_data);
	} catch (const Standard_Failure &) {
		return 0;
	}
}

static int read_iges(const char *path)
{
	Message::DefaultMessenger()->ChangePrinters().Clear();
	IGESControl_Reader reader;
	if (reader.ReadFile(path) != IFSelect_RetDone)
		return 0;
	reader.TransferRoots();
	return reader.NbShapes();
}

const struct peer peer_occt = {
	"Open CASCADE",    OCC_VERSION_COMPLETE,
	surface,           drop,
	grid_curvatures,   grid_points,
	grid_sum,          points,
	curvatures,        curvature,
	interpolate_curve, interpolate_surface,
	offset,            poles,
	curves,            read_iges,
};
