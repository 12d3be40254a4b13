#pragma once

#include "robots/JobData.hpp"
#include "robots/JobName.hpp"

#include <tl/expected.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// A text that contains names of job values: "rack {station.type}". "{{" and "}}" are braces.
class JobTemplate final
{
    struct Piece
    {
        std::string text;
        std::optional<JobName> nameOrNull; ///< What follows the text.
    };

    std::vector<Piece> _pieces;

public:
    /// The error is a sentence.
    [[nodiscard]] static tl::expected<JobTemplate, std::string> Parse(std::string_view text);

    [[nodiscard]] std::vector<JobName> GetNames() const;

    /// A template of exactly one name has the type of its value; any other is a string. The error is the name for which the
    /// job has no value.
    [[nodiscard]] tl::expected<JobValue, JobName> Resolve(const JobData& data) const;
};

} // namespace ACS::Acsd
