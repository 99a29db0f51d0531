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

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::equilibriumSolver::makePreconditioner(const word& name)
{
    const label dim = mesh_.dim();
    objects& p = *petsc_;
    const label rows = label(mesh_.owned().count());

    // The rigid motions; for bodies of revolution uniform displacements
    if (name == "AMG")
    {
        Mat& A = p.matrices[0];
        Vec places;
        check(MatCreateVecs(A, &places, nullptr));
        check(VecSetBlockSize(places, dim));
        MatNullSpace motions;
        if (mesh_.radial() < 0)
        {
            double* x;
            check(VecGetArray(places, &x));
            toVector(mesh_.points(), x);
            check(VecRestoreArray(places, &x));
            check(MatNullSpaceCreateRigidBody(places, &motions));
        }
        else
        {
            Vec along[2];
            for (label k = 0; k < 2; ++k)
            {
                check(VecDuplicate(places, &along[k]));
                double* x;
                check(VecGetArray(along[k], &x));
                for (label i = 0; i < rows; ++i)
                {
                    x[2*i + k] = 1;
                    x[2*i + 1 - k] = 0;
                }
                check(VecRestoreArray(along[k], &x));
                check(VecNormalize(along[k], nullptr));
            }
            check
            (
                MatNullSpaceCreate
                (
                    PETSC_COMM_WORLD, PETSC_FALSE, 2, along, &motions
                )
            );
            check(VecDestroy(&along[0]));
            check(VecDestroy(&along[1]));
        }
        check(MatSetNearNullSpace(A, motions));
        check(MatNullSpaceDestroy(&motions));
        check(VecDestroy(&places));
    }
    forAll(p.matrices, i)
    {
        PC& pc = p.preconditioners[i];
        check(PCCreate(PETSC_COMM_WORLD, &pc));
        check(PCSetOperators(pc, p.matrices[i], p.matrices[i]));
        if (name == "Cholesky")
        {
            check(PCSetType(pc, PCCHOLESKY));
            check
            (
                PCFactorSetMatSolverType
                (
                    pc, Pstream::parRun() ? MATSOLVERMUMPS : MATSOLVERCHOLMOD
                )
            );
        }
        else
        {
            check(PCSetType(pc, PCGAMG));
        }
        check(PCSetFromOptions(pc));
        check(PCSetUp(pc));
        check(MatCreateVecs(p.matrices[i], &p.to[i], &p.from[i]));
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::equilibriumSolver::precondition
(
    const double* from,
    double* to
) const
{
    // With the diagonals D of the matrix and U of the uniform medium M:
    // sqrt(U/D) M^-1 sqrt(U/D)
    objects& p = *petsc_;
    const label dim = mesh_.dim(), parts = p.matrices.size();
    const label rows = parts == 1 ? 0 : label(mesh_.owned().count());
    toField(from, in_);
    in_ *= scaling_;
    walls_.removeConstrained(in_);

    double* x;
    if (parts == 1)
    {
        VecGetArray(p.from[0], &x);
        toVector(in_, x);
        VecRestoreArray(p.from[0], &x);
    }
    else
    {
        scalarField all(dim*rows);
        toVector(in_, all.data());
        for (label k = 0; k < dim; ++k)
        {
            VecGetArray(p.from[k], &x);
            for (label i = 0; i < rows; ++i)
            {
                x[i] = all[dim*i + k];
            }
            VecRestoreArray(p.from[k], &x);
        }
    }
    for (label k = 0; k < parts; ++k)
    {
        check(PCApply(p.preconditioners[k], p.from[k], p.to[k]));
    }
    const double* y;
    if (parts == 1)
    {
        VecGetArrayRead(p.to[0], &y);
        toField(y, in_);
        VecRestoreArrayRead(p.to[0], &y);
    }
    else
    {
        scalarField all(dim*rows);
        for (label k = 0; k < dim; ++k)
        {
            VecGetArrayRead(p.to[k], &y);
            for (label i = 0; i < rows; ++i)
            {
                all[dim*i + k] = y[i];
            }
            VecRestoreArrayRead(p.to[k], &y);
        }
        toField(all.cdata(), in_);
    }
    walls_.removeConstrained(in_);
    in_ *= scaling_;
    walls_.tie(in_);
    toVector(in_, to);
}


// ************************************************************************* //
