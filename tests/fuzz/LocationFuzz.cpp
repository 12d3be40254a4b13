#include "FuzzCheck.hpp"
#include <acs/core/Location.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    const Core::Result<Core::Location> first = Core::Location::Parse(Fuzz::AsText(data, size));
    Fuzz::Require(
        Core::Location::IsLocation(Fuzz::AsText(data, size)) == first.has_value(),
        "IsLocation and Parse agree");
    if (first)
    {
        const Core::Result<Core::Location> second = Core::Location::Parse(first->GetText());
        Fuzz::Require(second.has_value(), "the canonical text of a location is a location");
        Fuzz::Require(*second == *first, "parsing the canonical text gives the same location");
        Fuzz::Require(!second->WasNormalised(), "the canonical text is canonical");
    }
    static_cast<void>(Core::ParseLocationRange(Fuzz::AsText(data, size)));
    return 0;
}
