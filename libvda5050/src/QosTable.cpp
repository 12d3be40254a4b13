#include <acs/vda5050/QosTable.hpp>

#include <cassert>
#include <cstddef>

namespace ACS::VDA5050
{

QosTable::QosTable()
    : QosTable(EQosProfile::Project)
{
}

QosTable::QosTable(EQosProfile profile)
{
    for (std::size_t index = 0; index < TOPIC_COUNT; ++index)
    {
        _levels.at(index) = GetQos(static_cast<ETopic>(index), profile);
    }
}

std::uint8_t QosTable::Get(ETopic topic) const
{
    return _levels.at(static_cast<std::size_t>(topic));
}

void QosTable::Set(ETopic topic, std::uint8_t qos)
{
    assert(qos <= 2);
    _levels.at(static_cast<std::size_t>(topic)) = qos;
}

} // namespace ACS::VDA5050
