// Terrain from GeoTIFF files by GDAL's C functions, in a library with the part GEOTIFF.

#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "morsel/core/error.h"
#include "morsel/core/io/decompression.h"
#include "morsel/core/io/elevation_grid.h"
#include "morsel/core/io/geotiff.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace {

/// Keeps the first error of GDAL on this thread while it lives; nothing is printed.
class GdalErrors {
 public:
  GdalErrors() { CPLPushErrorHandlerEx(receive, this); }
  ~GdalErrors() { CPLPopErrorHandler(); }
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  /// Throws the BadInput: what failed, and what GDAL says about it.
  [[noreturn]] void fail(const std::string& file, const std::string& what) const {
    fail_reading(file, first_.empty() ? what : what + ": " + first_);
  }

 private:
  static void CPL_STDCALL receive(CPLErr kind, CPLErrorNum, const char* message) {
    auto& errors = *static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    if (kind < CE_Failure || !errors.first_.empty()) return;
    // One line without what may be bytes of the file.
    for (const char* c = message; *c != '\0' && errors.first_.size() < 200; ++c)
      errors.first_ += *c >= ' ' && *c <= '~' ? *c : ' ';
  }
  std::string first_;
};

/// The bytes as a file of GDAL's own in memory, so that nothing beside the file is looked for.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) {
    static std::atomic<std::uint64_t> number{0};
    name_ = "/vsimem/morsel_" + std::to_string(number++) + ".tif";
    // GDAL takes the bytes as its own to change, which a file opened for reading is not.
    auto* data = const_cast<GByte*>(reinterpret_cast<const GByte*>(bytes.data()));
    VSILFILE* file = VSIFileFromMemBuffer(name_.c_str(), data, bytes.size(), FALSE);
    if (file != nullptr) VSIFCloseL(file);
  }
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const char* name() const { return name_.c_str(); }

 private:
  std::string name_;
};

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};

class GeoTiffReader {
 public:
  GeoTiffReader(std::string_view bytes, const std::string& file, const Progress& progress)
      : file_(file), progress_(progress), size_(bytes.size()), memory_(bytes) {}

  LoadedSoup read() {
    open();
    read_place();
    read_values();
    LoadedSoup result = make_terrain(std::move(grid_), file_, progress_);
    result.warnings.insert(result.warnings.begin(), warnings_.begin(), warnings_.end());
    return result;
  }

 private:
  void open() {
    // This driver alone, whatever else the system's GDAL has.
    static std::once_flag registered;
    std::call_once(registered, GDALRegister_GTiff);
    const std::array<const char*, 2> drivers = {"GTiff", nullptr};
    const std::array<const char*, 2> siblings = {nullptr, nullptr};
    dataset_.reset(GDALOpenEx(memory_.name(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr,
                              siblings.data()));
    if (!dataset_) errors_.fail(file_, "it is no TIFF file that GDAL can read");
    const int bands = GDALGetRasterCount(dataset_.get());
    if (bands < 1) errors_.fail(file_, "it has no band");
    grid_.columns = static_cast<std::size_t>(std::max(0, GDALGetRasterXSize(dataset_.get())));
    grid_.rows = static_cast<std::size_t>(std::max(0, GDALGetRasterYSize(dataset_.get())));
    check_grid_size(grid_.columns, grid_.rows, file_);
    band_ = GDALGetRasterBand(dataset_.get(), 1);
    const GDALDataType type = GDALGetRasterDataType(band_);
    check_expansion(static_cast<std::uint64_t>(bands) *
                    static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(type)));
    if (GDALDataTypeIsComplex(type) != 0)
      fail_reading(file_, std::string("its band 1 has numbers of type ") + GDALGetDataTypeName(type) +
                              ", which are no elevations");
    const GDALColorInterp colour = GDALGetRasterColorInterpretation(band_);
    if (colour == GCI_RedBand || colour == GCI_PaletteIndex)
      fail_reading(file_, std::string("it is a picture, not a terrain: its band 1 has ") +
                              (colour == GCI_RedBand ? "the red of colours" : "numbers of colours"));
    if (bands > 1)
      warnings_.push_back("it has " + std::to_string(bands) + " bands, of which the first is read");
  }

  /// Of the grid, and of a block, which GDAL decompresses as a whole, whose cells may have all bands.
  void check_expansion(std::uint64_t bytes_per_cell) const {
    const std::string cells = std::to_string(grid_.columns * grid_.rows) + " cells";
    DecompressionBudget(size_).take(grid_.columns * grid_.rows,
                                    std::max<std::uint64_t>(sizeof(double), bytes_per_cell), file_, cells);
    int columns = 0, rows = 0;
    GDALGetBlockSize(band_, &columns, &rows);
    DecompressionBudget(size_).take(
        static_cast<std::uint64_t>(std::max(columns, 0)) * static_cast<std::uint64_t>(std::max(rows, 0)),
        bytes_per_cell, file_,
        "a block of " + std::to_string(columns) + " by " + std::to_string(rows) + " cells");
  }

  void read_place() {
    std::array<double, 6> g = {0, 1, 0, 0, 0, -1};
    if (GDALGetGeoTransform(dataset_.get(), g.data()) != CE_None) {
      g = {0, 1, 0, 0, 0, -1};
      warnings_.push_back("it has no georeference: its cells are squares of side 1");
    }
    grid_.along_row = {g[1], g[4]};
    grid_.to_next_row = {g[2], g[5]};
    grid_.first = ElevationGrid::Step(g[0], g[3]) + 0.5 * (grid_.along_row + grid_.to_next_row);
    if (!grid_.first.allFinite()) fail_reading(file_, "its georeference is not finite");
    const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset_.get());
    grid_.in_degrees = system != nullptr && OSRIsGeographic(system) != 0;
  }

  /// Rows of blocks at a time.
  void read_values() {
    const auto columns = static_cast<int>(grid_.columns);
    const auto rows = static_cast<int>(grid_.rows);
    int block_columns = 0, block_rows = 0;
    GDALGetBlockSize(band_, &block_columns, &block_rows);
    block_rows = std::clamp(block_rows, 1, rows);
    int has_no_data = FALSE;
    const double no_data = GDALGetRasterNoDataValue(band_, &has_no_data);
    const double scale = GDALGetRasterScale(band_, nullptr);
    const double offset = GDALGetRasterOffset(band_, nullptr);
    const bool masked = GDALGetMaskFlags(band_) != GMF_ALL_VALID;
    const GDALRasterBandH mask_band = masked ? GDALGetMaskBand(band_) : nullptr;
    std::vector<std::uint8_t> mask;
    grid_.values.resize(grid_.columns * grid_.rows);
    for (int row = 0; row < rows; row += block_rows) {
      progress_.update("reading the mesh", static_cast<double>(row) / rows);
      const int count = std::min(block_rows, rows - row);
      double* values = grid_.values.data() + static_cast<std::size_t>(row) * grid_.columns;
      const std::size_t size = static_cast<std::size_t>(count) * grid_.columns;
      read_rows(band_, row, count, columns, values, GDT_Float64);
      if (mask_band != nullptr) {
        mask.resize(size);
        read_rows(mask_band, row, count, columns, mask.data(), GDT_Byte);
      }
      for (std::size_t i = 0; i < size; ++i) {
        const bool is_none =
            (mask_band != nullptr && mask[i] == 0) || (has_no_data != 0 && values[i] == no_data);
        if (is_none)
          values[i] = std::numeric_limits<double>::quiet_NaN();
        else if (scale != 1 || offset != 0)
          values[i] = values[i] * scale + offset;
      }
    }
  }

  void read_rows(GDALRasterBandH band, int row, int count, int columns, void* values,
                 GDALDataType type) const {
    if (GDALRasterIO(band, GF_Read, 0, row, columns, count, values, columns, count, type, 0, 0) != CE_None)
      errors_.fail(file_, "its rows " + std::to_string(row + 1) + " to " + std::to_string(row + count) +
                              " cannot be read");
  }

  const std::string& file_;
  const Progress& progress_;
  std::size_t size_;
  GdalErrors errors_;  // outlives what may have errors
  MemoryFile memory_;
  std::unique_ptr<void, CloseDataset> dataset_;
  GDALRasterBandH band_ = nullptr;
  ElevationGrid grid_;
  std::vector<std::string> warnings_;
};

}  // namespace

LoadedSoup read_geotiff(std::string_view bytes, const std::string& file, const Progress& progress) {
  return GeoTiffReader(bytes, file, progress).read();
}

}  // namespace morsel::core
