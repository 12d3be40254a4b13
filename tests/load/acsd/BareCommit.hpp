#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace ACS::Load
{

/// The cheapest durable write of a text: a table of one column, a transaction for each text, WAL and FULL. Throws
/// the exceptions of SQLite.
class BareCommit
{
    struct Impl;
    std::unique_ptr<Impl> _impl;

public:
    explicit BareCommit(const std::string& path);
    BareCommit(const BareCommit&) = delete;
    BareCommit& operator=(const BareCommit&) = delete;
    ~BareCommit();

    void Commit(std::string_view text);
};

} // namespace ACS::Load
