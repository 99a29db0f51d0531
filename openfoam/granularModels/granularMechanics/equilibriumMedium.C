/*---------------------------------------------------------------------------*\
  =========                 |
  \\      /  F ield         | MSDD: multiscale data-driven heat conduction
   \\    /   O peration     |       in granular media
    \\  /    A nd           | for OpenFOAM
     \\/     M anipulation  |
-------------------------------------------------------------------------------
License
    SPDX-License-Identifier: GPL-3.0-or-later

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty: see the file LICENSE.
\*---------------------------------------------------------------------------*/

#include "petscObjects.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Projections on the components that are free, of nodes that are held
class freeComponents
{
    const wallConditions& walls_;
    const label dim_;
    labelList heldIndex_;

public:

    freeComponents(const elementMesh& mesh, const wallConditions& walls)
    :
        walls_(walls),
        dim_(mesh.dim()),
        heldIndex_(mesh.size(), -1)
    {
        forAll(walls.constrainedNodes(), i)
        {
            heldIndex_[walls.constrainedNodes()[i]] = i;
        }
    }

    //- Set the projection; returns whether the node is held
    bool find(const label node, tensor& P) const
    {
        P = tensor::I;
        const label i = heldIndex_[node];
        for (label k = 0; i >= 0 && k < walls_.directions()[i]; ++k)
        {
            const scalar* e = walls_.basis().cdata() + dim_*dim_*i + dim_*k;
            const vector n(e[0], e[1], dim_ == 3 ? e[2] : 0);
            P -= n*n;
        }
        return i >= 0;
    }
};

//- Stiffness K_ij of the uniform medium between two nodes with the gradients Ba
//- and Bb of their shapes, and of bodies of revolution the hoop strains, else null
template<label dim>
static void setStiffness
(
    scalar (&K)[dim][dim],
    const scalar* Ba,
    const scalar* Bb,
    const scalar* hoopA,
    const scalar* hoopB,
    const label r,
    const scalar V,
    const scalar lambda,
    const scalar G,
    const scalar stabilisation
)
{
    scalar both = 0;
    for (label k = 0; k < dim; ++k)
    {
        both += Ba[k]*Bb[k];
    }
    const scalar diagonal = V*G*both + stabilisation;
    for (label i = 0; i < dim; ++i)
    {
        for (label j = 0; j < dim; ++j)
        {
            K[i][j] =
                V*(lambda*Ba[i]*Bb[j] + G*Ba[j]*Bb[i])
              + (i == j ? diagonal : 0);
            if (hoopA)
            {
                K[i][j] +=
                    V
                   *(
                        lambda*(j == r)*Ba[i]*(*hoopB)
                      + lambda*(i == r)*(*hoopA)*Bb[j]
                      + (lambda + 2*G)*(i == r)*(j == r)*(*hoopA)*(*hoopB)
                    );
            }
        }
    }
}


//- K becomes P.K.Q
template<label dim>
static void project(scalar (&K)[dim][dim], const tensor& P, const tensor& Q)
{
    scalar part[dim][dim] = {};
    for (label i = 0; i < dim; ++i)
    {
        for (label j = 0; j < dim; ++j)
        {
            for (label k = 0; k < dim; ++k)
            {
                part[i][j] += P(i, k)*K[k][j];
            }
        }
    }
    for (label i = 0; i < dim; ++i)
    {
        for (label j = 0; j < dim; ++j)
        {
            K[i][j] = 0;
            for (label k = 0; k < dim; ++k)
            {
                K[i][j] += part[i][k]*Q(k, j);
            }
        }
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalarField Foam::equilibriumSolver::nodesAround() const
{
    scalarField around(mesh_.size(), Zero);
    labelList marked(mesh_.size(), -1), count(mesh_.size(), 0);
    labelListList cellsOfNode(mesh_.size());
    for (const label node : mesh_.cellNodes())
    {
        ++count[node];
    }
    forAll(count, node)
    {
        cellsOfNode[node].resize(count[node]);
    }
    count = 0;
    mesh_.each([&](const auto& e)
    {
        for (label a = 0; a < e.size(); ++a)
        {
            const label node = e.nodes[a];
            cellsOfNode[node][count[node]++] = e.cell;
        }
    });
    const auto& starts = mesh_.cellStarts();
    forAll(cellsOfNode, node)
    {
        for (const label celli : cellsOfNode[node])
        {
            for (label i = starts[celli]; i < starts[celli + 1]; ++i)
            {
                const label other = mesh_.cellNodes()[i];
                around[node] += marked[other] != node;
                marked[other] = node;
            }
        }
    }
    mesh_.sum(around, 1);
    return around;
}


void Foam::equilibriumSolver::makeMatrix(const label component)
{
    const label each = component < 0 ? mesh_.dim() : 1;
    const label rows = each*label(mesh_.owned().count());
    Mat& A = petsc_->matrices[component < 0 ? 0 : component];
    const scalarField around(nodesAround());
    List<PetscInt> inside(rows), outside(rows);
    label row = 0;
    forAll(around, node)
    {
        if (mesh_.owned().test(node))
        {
            const PetscInt most(each*around[node]);
            for (label k = 0; k < each; ++k)
            {
                inside[row] = min(most, PetscInt(rows));
                outside[row++] = Pstream::parRun() ? most : 0;
            }
        }
    }
    check(MatCreate(PETSC_COMM_WORLD, &A));
    check(MatSetSizes(A, rows, rows, PETSC_DECIDE, PETSC_DECIDE));
    check(MatSetBlockSize(A, each));
    check(MatSetType(A, MATAIJ));
    check(MatSeqAIJSetPreallocation(A, 0, inside.cdata()));
    check(MatMPIAIJSetPreallocation(A, 0, inside.cdata(), 0, outside.cdata()));
    check(MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(A, MAT_SPD, PETSC_TRUE));
}


void Foam::equilibriumSolver::addMedium
(
    const elementMesh::shapes& reference,
    const label component
)
{
    Mat& A = petsc_->matrices[component < 0 ? 0 : component];
    const freeComponents freed(mesh_, walls_);
    const label r = mesh_.radial();
    List<PetscInt> indices;
    List<PetscScalar> values;
    List<tensor> P;
    List<bool> held;

    mesh_.each([&](const auto& e)
    {
        constexpr label dim = std::decay<decltype(e)>::type::dim;
        const label n = e.size();
        const scalar* B = reference.gradient.cdata() + dim*e.start;
        const scalar* hoop =
            r < 0 ? nullptr : reference.hoop.cdata() + e.start;
        const scalar s =
            unfitted_*shear_*mesh_.stabilisationScale(e.cell, reference);
        indices.resize(max(indices.size(), n));
        values.resize(max(values.size(), n*dim*n*dim));
        P.resize(max(P.size(), n));
        held.resize(P.size());
        for (label a = 0; a < n; ++a)
        {
            indices[a] = number_[e.nodes[a]];
            held[a] = freed.find(e.nodes[a], P[a]);
        }
        for (label a = 0; a < n; ++a)
        {
            for (label b = 0; b < n; ++b)
            {
                scalar K[dim][dim];
                setStiffness<dim>
                (
                    K, B + dim*a, B + dim*b, hoop ? hoop + a : nullptr,
                    hoop ? hoop + b : nullptr, r, reference.volume[e.cell],
                    lambda_, shear_, s*mesh_.stabilisation(e, a, b)
                );
                if (held[a] || held[b])
                {
                    project<dim>(K, P[a], P[b]);
                }
                if (component >= 0)
                {
                    values[n*a + b] = K[component][component];
                    continue;
                }
                for (label i = 0; i < dim; ++i)
                {
                    for (label j = 0; j < dim; ++j)
                    {
                        values[(dim*a + i)*n*dim + dim*b + j] = K[i][j];
                    }
                }
            }
        }
        const auto set = component < 0 ? MatSetValuesBlocked : MatSetValues;
        check
        (
            set
            (
                A, n, indices.cdata(), n, indices.cdata(), values.cdata(),
                ADD_VALUES
            )
        );
    });
}


void Foam::equilibriumSolver::addWalls(const label component)
{
    Mat& A = petsc_->matrices[component < 0 ? 0 : component];
    const label dim = mesh_.dim();
    const freeComponents freed(mesh_, walls_);
    const auto add = [&](const label node, const tensor& more)
    {
        if (!mesh_.owned().test(node))
        {
            return;
        }
        const label index = number_[node];
        const auto set = [&](const label row, const label column, const scalar x)
        {
            check(MatSetValue(A, row, column, x, ADD_VALUES));
        };
        if (component >= 0)
        {
            set(index, index, more(component, component));
            return;
        }
        for (label i = 0; i < dim; ++i)
        {
            for (label j = 0; j < dim; ++j)
            {
                set(dim*index + i, dim*index + j, more(i, j));
            }
        }
    };
    walls_.forEachTangentialStiffness
    (
        [&](const label node, const scalar* t, const scalar k)
        {
            tensor P;
            freed.find(node, P);
            const vector along(P & vector(t[0], t[1], dim == 3 ? t[2] : 0));
            add(node, k*(along*along));
        }
    );
    for (const label node : walls_.constrainedNodes())
    {
        tensor P;
        freed.find(node, P);
        scalar size = 0;
        for (label k = 0; k < dim; ++k)
        {
            size = max(size, mediumDiagonal_[dim*node + k]);
        }
        add(node, size*(tensor::I - P));
    }
}


void Foam::equilibriumSolver::assemble
(
    const elementMesh::shapes& reference,
    const label component
)
{
    makeMatrix(component);
    addMedium(reference, component);
    addWalls(component);
    Mat& A = petsc_->matrices[component < 0 ? 0 : component];
    check(MatAssemblyBegin(A, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(A, MAT_FINAL_ASSEMBLY));
}


// ************************************************************************* //
