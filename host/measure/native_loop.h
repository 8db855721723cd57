// Included once per instruction set by native.cpp. One row of pixels, `width` at a time.
//
// x86's max and min return the second operand if one is NaN: samples on background (infinite or NaN distances) end as 0.

// Cosine and sine of 0 to pi/4.
inline void cosine_sine(F a, F& cosine, F& sine) {
  const F b = a * a;
  cosine = fma(fma(fma(fma(b, all(1.0f / 40320), all(-1.0f / 720)), b, all(1.0f / 24)), b, all(-0.5f)), b, all(1));
  sine = a * fma(fma(fma(b, all(-1.0f / 5040), all(1.0f / 120)), b, all(-1.0f / 6)), b, all(1));
}

// The pixel noise of kernels/shared/sampling/sample.h, by column.
constexpr uint32_t turn_across = 0x8e42b7fdu, shift_across = 0xc13fa9a9u;

// Constants of one row.
struct RowConstants {
  F scale_x, scale_y, origin_x, origin_y;  // position at depth 1 = scale * pixel + origin
  F bias, inverse_square;
  int last_x, last_y, pitch;
};

// The pixel at hand.
struct Point {
  F x, y, z;     // view space; z is the depth
  F nx, ny, nz;  // nz is negated, since depth points away
  F least;       // a squared distance above the rounding of x and y, so that the point itself stays below any bias
};

inline F obscurance(const RowConstants& r, const Point& p, I ix, I iy, F depth) {
  const F vx = fms(fma(converted(ix), r.scale_x, r.origin_x), depth, p.x);
  const F vy = fms(fma(converted(iy), r.scale_y, r.origin_y), depth, p.y);
  const F vz = depth - p.z;
  const F vv = fma(vx, vx, fma(vy, vy, vz * vz));
  const F nv = fma(p.nx, vx, fma(p.ny, vy, p.nz * vz));
  const F cosine = nv * inverse_sqrt(larger(vv, p.least));
  return larger(cosine - r.bias, all(0)) * larger(fnma(vv, r.inverse_square, all(1)), all(0));
}

// AO of the block of pixels from column x; z: their depths. `inside`: every sample lies in the frame.
template <bool inside>
inline F open_share(const Job& job, const RowConstants& r, int x, int y, size_t here, uint32_t first_turn,
                    uint32_t first_shift, F z) {
  const PixelCamera& c = job.camera;
  const F column = all(float(x)) + iota();
  const F nx = load(job.normal_x + here), ny = load(job.normal_y + here), nz = all(0) - load(job.normal_z + here);
  const F least = all(4e-6f) * z;
  const Point p{fma(column, r.scale_x, r.origin_x) * z,
                fma(all(float(y)), r.scale_y, r.origin_y) * z,
                z,
                nx,
                ny,
                nz,
                least * least};

  const F turn = random(plus(times(iota_u(), int(turn_across)), int(first_turn))) * all(2 * pi / directions);
  const F shift = random(plus(times(iota_u(), int(shift_across)), int(first_shift)));
  const F reach = all(job.radius) / z, most = all(job.max_pixels), zero = all(0);
  const F stride_x = larger(smaller(reach * all(1 / c.scale_x), most) - all(1), zero) * all(1.0f / steps);
  const F stride_y = larger(smaller(reach * all(1 / c.scale_y), most) - all(1), zero) * all(1.0f / steps);
  const F px = column + all(0.5f), py = all(float(y) + 0.5f);

  F cosine, sine;
  cosine_sine(turn, cosine, sine);
  F sum = zero;
  for (int d = 0; d < directions; ++d) {
    F away_x = fma(shift, stride_x, all(1)), away_y = fma(shift, stride_y, all(1));
    GLOAM_UNROLL
    for (int k = 0; k < steps; ++k) {
      I ix = truncated(fma(cosine, away_x, px)), iy = truncated(fma(sine, away_y, py));
      if constexpr (!inside) {
        ix = smaller_i(larger_i(ix, 0), r.last_x);
        iy = smaller_i(larger_i(iy, 0), r.last_y);
      }
      sum = sum + obscurance(r, p, ix, iy, gather(job.depth, plus(times(iy, r.pitch), ix)));
      away_x = away_x + stride_x;
      away_y = away_y + stride_y;
    }
    // The next direction, an eighth of a turn further.
    const F next = fms(cosine, all(step_cosine), sine * all(step_sine));
    sine = fma(sine, all(step_cosine), cosine * all(step_sine));
    cosine = next;
  }
  const F open = fnma(sum, all(job.strength * 2 / (directions * steps)), all(1));
  return smaller(larger(open, zero), all(1));
}

// Whether the reach of every pixel of the block lies within the frame.
inline bool reaches_only_inside(const Job& job, int x, int y, F z) {
  const PixelCamera& c = job.camera;
  const float per_depth = job.radius / smallest(z);
  const float reach_x = std::min(per_depth / c.scale_x, job.max_pixels) + 2;
  const float reach_y = std::min(per_depth / c.scale_y, job.max_pixels) + 2;
  return x >= reach_x && x + width + reach_x <= c.width && y >= reach_y && y + 1 + reach_y <= c.height;
}

// `tuned`: clamps samples only in blocks that reach out of the frame.
template <bool tuned>
inline void row(const Job& job, int y) {
  const PixelCamera& c = job.camera;
  const RowConstants r{all(c.scale_x),
                       all(-c.scale_y),
                       all((0.5f - c.centre_x) * c.scale_x),
                       all((c.centre_y - 0.5f) * c.scale_y),
                       all(job.bias),
                       all(job.inverse_square),
                       c.width - 1,
                       c.height - 1,
                       c.pitch};
  const uint32_t seed = uint32_t(c.seed);
  for (int x = 0; x < c.pitch; x += width) {
    const size_t here = size_t(y) * size_t(c.pitch) + size_t(x);
    const F z = load(job.depth + here);
    F open = all(1);
    if (!all_infinite(z)) {
      const uint32_t first_turn = uint32_t(x) * turn_across + uint32_t(y) * 0x4f2cbe3cu + seed * 0x9e3779b9u;
      const uint32_t first_shift = uint32_t(x) * shift_across + uint32_t(y) * 0x91e10da6u + seed * 0x6a09e667u;
      const bool inside = tuned && reaches_only_inside(job, x, y, z);
      const F share = inside ? open_share<true>(job, r, x, y, here, first_turn, first_shift, z)
                             : open_share<false>(job, r, x, y, here, first_turn, first_shift, z);
      open = where_infinite(z, open, share);
    }
    store(job.ao + here, open);
  }
}
