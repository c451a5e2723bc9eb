#include "canvas.h"

#include <cctype>
#include <cmath>
#include <exception>
#include <new>

#include "bytes.h"
#include "cairo_library.h"
#include "drawable_text.h"
#include "status.h"

namespace tetstream {

static uint32_t byteOf(double share) {
  return static_cast<uint32_t>(std::lround(share * 255));
}

void Image::set(size_t x, size_t y, Colour c) {
  pixels_[y * width_ + x] = byteOf(c.red) << 16 | byteOf(c.green) << 8 | byteOf(c.blue);
}

#ifdef TETSTREAM_WITH_CAIRO

static bool endsIn(const std::string& path, const char* extension) {
  const std::string wanted = extension;
  if (path.size() <= wanted.size()) return false;
  for (size_t i = 0, at = path.size() - wanted.size(); i < wanted.size(); ++i)
    if (std::tolower(static_cast<unsigned char>(path[at + i])) != wanted[i]) return false;
  return true;
}

void checkPicture(const std::string& path) {
  if (!endsIn(path, ".svg") && !endsIn(path, ".png"))
    fail(Status::kUnsupported, "%s: a picture's name ends in .svg or .png", path.c_str());
  cairo();
}

namespace {

constexpr double kPixelsPerPoint = 2;

// What cairo writes goes on to a sink; an Error on the way waits until cairo has returned.
struct Outlet {
  ByteSink& sink;
  std::exception_ptr error;

  static cairo_status_t write(void* outlet, const unsigned char* data, unsigned size) {
    auto* self = static_cast<Outlet*>(outlet);
    try {
      if (!self->error) self->sink.write(data, size);
    } catch (...) {
      self->error = std::current_exception();
    }
    return self->error ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
  }
  void check(cairo_status_t status) const {
    if (error) std::rethrow_exception(error);
    if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
    if (status != CAIRO_STATUS_SUCCESS)
      fail(Status::kInternal, "cairo: %s", cairo().status_to_string(status));
  }
};

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;

void finishAndDestroy(cairo_surface_t* surface) {
  cairo().surface_finish(surface);
  cairo().surface_destroy(surface);
}

class CairoCanvas final : public Canvas {
 public:
  explicit CairoCanvas(cairo_surface_t* surface) : pen_(cairo().create(surface)) {}
  ~CairoCanvas() override { c_.destroy(pen_); }
  CairoCanvas(const CairoCanvas&) = delete;
  CairoCanvas& operator=(const CairoCanvas&) = delete;
  cairo_status_t status() const { return c_.status(pen_); }
  void scale(double factor) { c_.scale(pen_, factor, factor); }

  void fill(const Frame& f, Colour colour) override {
    setColour(colour);
    c_.rectangle(pen_, f.left, f.top, f.width, f.height);
    c_.fill(pen_);
  }
  void fill(const std::vector<Point>& outline, Colour colour) override {
    setColour(colour);
    trace(outline);
    c_.close_path(pen_);
    c_.fill(pen_);
  }
  void line(const std::vector<Point>& path, double width, Colour colour, bool dashed) override {
    static constexpr double kDash[2] = {4, 3};
    setColour(colour);
    c_.set_line_width(pen_, width);
    c_.set_line_join(pen_, CAIRO_LINE_JOIN_ROUND);
    c_.set_dash(pen_, kDash, dashed ? 2 : 0, 0);
    trace(path);
    c_.stroke(pen_);
  }
  void text(Point at, const std::string& text, const TextStyle& style) override {
    const double shift = style.anchor * textWidth(text, style);
    setColour(style.colour);
    c_.save(pen_);
    c_.translate(pen_, at.x, at.y);
    if (style.upwards) c_.rotate(pen_, -1.5707963267948966);
    c_.move_to(pen_, -shift, 0);
    c_.show_text(pen_, drawableText(text).c_str());
    c_.restore(pen_);
  }
  double textWidth(const std::string& text, const TextStyle& style) override {
    c_.select_font_face(pen_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                        style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    c_.set_font_size(pen_, style.size);
    cairo_text_extents_t extents;
    c_.text_extents(pen_, drawableText(text).c_str(), &extents);
    return extents.x_advance;
  }
  void image(const Frame& frame, const Image& image) override;

 private:
  void setColour(Colour c) { c_.set_source_rgba(pen_, c.red, c.green, c.blue, c.alpha); }
  void trace(const std::vector<Point>& path) {
    c_.new_path(pen_);
    for (const Point& p : path) c_.line_to(pen_, p.x, p.y);  // the first one moves there
  }

  const Cairo& c_ = cairo();
  cairo_t* pen_;
};

// note: cairo takes without const what it only reads; finished, it looks at the pixels no more.
void CairoCanvas::image(const Frame& f, const Image& image) {
  const auto width = static_cast<int>(image.width()), height = static_cast<int>(image.height());
  auto* pixels = reinterpret_cast<unsigned char*>(const_cast<uint32_t*>(image.pixels()));
  const Surface source(
      c_.image_surface_create_for_data(pixels, CAIRO_FORMAT_RGB24, width, height, 4 * width),
      finishAndDestroy);
  c_.save(pen_);
  c_.translate(pen_, f.left, f.top);
  c_.scale(pen_, f.width / width, f.height / height);
  c_.set_source_surface(pen_, source.get(), 0, 0);
  c_.pattern_set_filter(c_.get_source(pen_), CAIRO_FILTER_GOOD);
  c_.paint(pen_);
  c_.restore(pen_);
}

void drawSvg(Outlet& outlet, double width, double height,
             const std::function<void(Canvas&)>& draw) {
  const Surface surface(
      cairo().svg_surface_create_for_stream(Outlet::write, &outlet, width, height),
      finishAndDestroy);
  CairoCanvas canvas(surface.get());
  draw(canvas);
  outlet.check(canvas.status());
  cairo().surface_finish(surface.get());
  outlet.check(cairo().surface_status(surface.get()));
}

void drawPng(Outlet& outlet, double width, double height,
             const std::function<void(Canvas&)>& draw) {
  const Surface surface(
      cairo().image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width * kPixelsPerPoint),
                                   static_cast<int>(height * kPixelsPerPoint)),
      finishAndDestroy);
  CairoCanvas canvas(surface.get());
  canvas.scale(kPixelsPerPoint);
  draw(canvas);
  outlet.check(canvas.status());
  outlet.check(cairo().surface_write_to_png_stream(surface.get(), Outlet::write, &outlet));
}

}  // namespace

void drawPicture(const std::string& path, double width, double height,
                 const std::function<void(Canvas&)>& draw) {
  checkPicture(path);
  const std::unique_ptr<ByteSink> file = createFile(path);
  Outlet outlet{*file, nullptr};
  const auto drawOnWhite = [&](Canvas& canvas) {
    canvas.fill(Frame{0, 0, width, height}, kWhite);
    draw(canvas);
  };
  (endsIn(path, ".svg") ? drawSvg : drawPng)(outlet, width, height, drawOnWhite);
  file->commit();
}

#else

void checkPicture(const std::string&) {
  fail(Status::kUnsupported, "this build draws no pictures: it was made without cairo");
}

void drawPicture(const std::string& path, double, double, const std::function<void(Canvas&)>&) {
  checkPicture(path);
}

#endif

}  // namespace tetstream
