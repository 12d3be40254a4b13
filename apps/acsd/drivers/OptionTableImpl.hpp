#pragma once

#include "common/config/ConfigReader.hpp"
#include "common/config/ConfigSection.hpp"
#include <acs/acsd/OptionTable.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

/// A table in another one, which becomes a known key of it at the first use: a driver without options accepts none.
class OptionTable::Impl final
{
public:
    using Warnings = std::vector<std::string>;

private:
    Apps::ConfigSection _parent;
    std::string _name; ///< Empty: the table is the parent itself.

public:
    const Apps::ConfigReader reader; ///< Of the whole document.
    const std::string path;
    const std::shared_ptr<Warnings> warnings;

    Impl(Apps::ConfigReader ofDocument, Apps::ConfigSection parent, std::string name, std::shared_ptr<Warnings> added)
        : _parent(std::move(parent)),
          _name(std::move(name)),
          reader(std::move(ofDocument)),
          path(_name.empty() ? _parent.GetPath() : _parent.GetPath() + "." + _name),
          warnings(std::move(added))
    {
    }

    [[nodiscard]] Apps::ConfigSection GetSection() const
    {
        return _name.empty() ? _parent : _parent.GetSection(_name);
    }
};

/// The table of that name in the parent, which is of the reader's document, for a driver. Its warnings are added to the list.
[[nodiscard]] OptionTable MakeOptionTable(
    const Apps::ConfigReader& reader,
    Apps::ConfigSection parent,
    std::string name,
    std::shared_ptr<std::vector<std::string>> warnings);

} // namespace ACS::Acsd
