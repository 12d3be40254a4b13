// needs: Boost Threads Mosquitto
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>

#include <cstdint>

namespace
{

class Listener final : public ACS::VDA5050::IMqttLinkListener
{
public:
    void OnLinkUp() override
    {
    }
    void OnLinkDown(std::error_code /*reason*/) override
    {
    }
    void OnMqttMessage(const ACS::VDA5050::MqttMessage& /*message*/) override
    {
    }
};

class ConstantRandom final : public ACS::Core::IRandom
{
public:
    [[nodiscard]] std::uint64_t GetNext() override
    {
        return 1;
    }
};

} // namespace

int main()
{
    boost::asio::io_context context;
    ConstantRandom random;
    Listener listener;
    ACS::VDA5050::MosquittoLink link(context.get_executor(), random, {}, {}, listener);
    return link.Publish({}).has_value() ? 1 : 0;
}
