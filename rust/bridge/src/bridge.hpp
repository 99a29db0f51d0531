// C++ side of the test bridge: calls msdd.hpp with types that cxx can pass between Rust and C++.
#pragma once

#include "msdd.hpp"
#include "rust/cxx.h"

#include <memory>

namespace bridge
{

struct Cells;

class Model
{
public:
    explicit Model(msdd::Model&& model) : model_(std::move(model)) {}

    std::size_t state_size() const { return model_.stateSize(); }
    rust::String hash() const { return model_.hash(); }
    rust::Vec<double> initial_state(rust::Slice<const double> porosity, rust::Slice<const double> fabricIndex) const;
    void advance(Cells& cells) const;
    void advance_with_wrong_size(Cells& cells) const;
    rust::Vec<double> wall_friction(double meanRadius) const;

    msdd::Model& wrapper() { return model_; }

private:
    void advance(Cells& cells, std::size_t structSize) const;

    msdd::Model model_;
};

std::unique_ptr<Model> load(rust::Str source);
std::unique_ptr<Model> moved(Model& model);
void move_into_itself(Model& model);
rust::Vec<double> strained_rves(double strain);
void trap();
bool trapped_and_clear();

} // namespace bridge
