#include "world/EWorldError.hpp"

#include <string>

namespace ACS::Sim
{
namespace
{

class WorldErrorCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "acs.world";
    }

    [[nodiscard]] std::string message(int condition) const override
    {
        switch (static_cast<EWorldError>(condition))
        {
            case EWorldError::InvalidPlace:
                return "invalid place";
            case EWorldError::NoSuchPlace:
                return "no such place";
            case EWorldError::PlaceEmpty:
                return "the place is empty";
            case EWorldError::PlaceOccupied:
                return "the place is occupied";
            case EWorldError::OtherCarrier:
                return "another carrier is there";
            case EWorldError::CoverClosed:
                return "the cover is closed";
            case EWorldError::OutOfReach:
                return "out of reach";
            case EWorldError::InvalidName:
                return "invalid name";
            case EWorldError::LimitExceeded:
                return "limit exceeded";
            case EWorldError::JournalFailed:
                return "journal failed";
            default:
                return "unknown error";
        }
    }
};

} // namespace

std::error_code make_error_code(EWorldError error) noexcept
{
    static const WorldErrorCategory CATEGORY;
    return {static_cast<int>(error), CATEGORY};
}

} // namespace ACS::Sim
