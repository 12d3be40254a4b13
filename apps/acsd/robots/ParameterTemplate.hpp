#pragma once

#include "robots/JobTemplate.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <tl/expected.hpp>
#include <toml++/toml.h>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

/// The value of a parameter of a vehicle's action: a scalar, or a table or list of scalars. Strings are templates.
class ParameterTemplate final
{
    using Scalar = std::variant<JobTemplate, std::int64_t, double, bool>;

    /// JSON text, and the scalar that follows it.
    struct Piece
    {
        std::string json;
        std::optional<Scalar> scalarOrNull;
    };

    std::vector<Piece> _pieces; ///< A scalar is one piece without text.

    ParameterTemplate() = default;

public:
    /// The error is a sentence.
    [[nodiscard]] static tl::expected<ParameterTemplate, std::string> Make(const toml::node& node);

    /// A string.
    [[nodiscard]] static tl::expected<ParameterTemplate, std::string> Make(std::string_view text);

    [[nodiscard]] std::vector<JobName> GetNames() const;

    /// A value of the type that the vehicle's factsheet declares; without one, of the type in the TOML file. The error names
    /// the name for which the job has no value, or the value of another type.
    [[nodiscard]] tl::expected<Core::JsonText, std::string> Resolve(
        const JobData& data,
        std::optional<VDA5050::EValueDataType> typeOrNull) const;

private:
    /// Appends the pieces of the value; the JSON text after the last one stays in `json`. Returns an error as a sentence.
    [[nodiscard]] std::optional<std::string> AppendRecursiveOrNull(const toml::node& node, std::string& json);
    [[nodiscard]] bool IsScalar() const noexcept;
    [[nodiscard]] std::string_view GetJsonKind() const noexcept;
};

} // namespace ACS::Acsd
