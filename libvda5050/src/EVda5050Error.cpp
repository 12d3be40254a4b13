#include <acs/vda5050/EVda5050Error.hpp>

#include <string>

namespace ACS::VDA5050
{

namespace
{

class Vda5050Category final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "acs.vda5050";
    }

    [[nodiscard]] std::string message(int value) const override
    {
        switch (static_cast<EVda5050Error>(value))
        {
            case EVda5050Error::InvalidTopic:
                return "not a VDA5050 topic";
            case EVda5050Error::UnsupportedVersion:
                return "unsupported protocol version";
            case EVda5050Error::InvalidOrder:
                return "the order breaks a rule of its structure";
            case EVda5050Error::VehicleNotReady:
                return "the vehicle is not ready";
            case EVda5050Error::OrderActive:
                return "another order is not finished";
            case EVda5050Error::NoOrder:
                return "there is no order";
            case EVda5050Error::UpdatePending:
                return "an order update already waits";
            case EVda5050Error::NotSupported:
                return "the vehicle's factsheet does not support it";
            default:
                return "unknown VDA5050 error";
        }
    }
};

} // namespace

std::error_code make_error_code(EVda5050Error error) noexcept
{
    static const Vda5050Category CATEGORY;
    return {static_cast<int>(error), CATEGORY};
}

} // namespace ACS::VDA5050
