#pragma once

#include <pybind11/numpy.h>

#include <ranges>
#include <utility>
#include <vector>

namespace mis::python {

/// A NumPy array over a vector's own memory, which it keeps: nothing is copied. `Scalar` is what a
/// T is made of; the shape counts scalars.
template <class Scalar, class T>
pybind11::array_t<Scalar> array_of(std::vector<T>&& values, pybind11::array::ShapeContainer shape)
{
    static_assert(sizeof(T) % sizeof(Scalar) == 0);
    auto* const kept = new std::vector<T>(std::move(values));
    const pybind11::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
    return pybind11::array_t<Scalar>(std::move(shape),
                                     reinterpret_cast<const Scalar*>(kept->data()), owner);
}

/// A read-only view of one member of every element of a vector that `owner` keeps as it is.
template <class Scalar, std::ranges::contiguous_range Elements>
pybind11::array_t<Scalar> view_of(const Elements& elements, const Scalar* first_member,
                                  int components, pybind11::handle owner)
{
    const auto count = static_cast<pybind11::ssize_t>(elements.size());
    pybind11::array::ShapeContainer shape{count};
    pybind11::array::StridesContainer strides{
        static_cast<pybind11::ssize_t>(sizeof(*elements.data()))};
    if (components > 1) {
        shape->push_back(components);
        strides->push_back(static_cast<pybind11::ssize_t>(sizeof(Scalar)));
    }
    pybind11::array_t<Scalar> array(std::move(shape), std::move(strides), first_member, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

}  // namespace mis::python
