#pragma once

#include "app/compare/picture_comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera {

/// A picture that was compared.
struct ComparedPicture {
    std::filesystem::path path;
    PictureComparison errors;
};

/// Files and layer that all pictures of a run have in common.
struct ComparisonInputs {
    std::string layer;                           ///< of the pictures; empty: the one that each file shows
    std::filesystem::path reference, reference2; ///< reference2 is empty if there is one
};

/// Returns the errors of one picture, a line each, with their meaning.
std::string to_text(const PictureComparison& errors);

/// Returns a table with a line for each picture.
std::string to_table(const std::vector<ComparedPicture>& pictures);

/// Returns an object for one picture, an array of such objects for any other number. Numbers that are not finite
/// are null, except for the PSNR of equal pictures, which is "inf".
std::string to_json(const ComparisonInputs& inputs, const std::vector<ComparedPicture>& pictures);

/// Returns a line for each picture after a line of names; values that are missing or NaN are empty, infinity is
/// inf.
std::string to_csv(const ComparisonInputs& inputs, const std::vector<ComparedPicture>& pictures);

} // namespace tessera
